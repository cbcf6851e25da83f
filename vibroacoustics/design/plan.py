"""Expected time, memory and disk space of a sweep, before it starts."""

import json
import time
import zlib
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
import psutil

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..results.size import MOST_BYTES
from .dataset import cells
from .engine.memo import MOST_BYTES as MOST_KEPT_BYTES
from .explaining import SPREAD_DESIGNS
from .problem import Problem
from .space import OPTION
from .sweep_values import BLOCK, MOST_SHOWN, Listing
from .trial import Trial, tried

LONGEST_S: Final = 12 * 3600.0
"""Longest time of a sweep unless more is allowed."""
_WRITTEN: Final = 2_000
"""Designs that are written to see how large they are."""
_FURTHER_BYTES: Final = 5.0
"""Bytes of a row of the table: whether a design is allowed, and ends of cells."""
_REPORT_S, _SHOWN_S = 0.5, 1.1e-5
"""Processor time of a report, and of each design that it shows."""
_SELECTED_S, _SORTED_S = 1.0, 1.6e-6
"""Processor time of the selection of designs for a report, and of each of very many designs."""
_LABELLED_S: Final = 5e-8
"""Processor time of the value of a variable in a sample."""
_REPORT_BYTES: Final = 150_000
"""Files of a sweep without designs: the study in the dataset, the report, its pictures."""
_REPORT_ROW: Final = 1.1
"""Row of the report's table of designs over that of the sweep's table."""
_REPORT_MEMORY_BYTES: Final = 60e6
_BLOCK_BYTES: Final = 100e6
"""Memory of a block of designs in work, and of the pieces of a file."""


@dataclass(frozen=True)
class Plan:
    """Size of a sweep.

    Attributes
    ----------
    designs, pieces : number of them; a piece is a design with a sample of its tolerances
    speeds : number of them
    seconds : expected time, s
    memory_bytes : expected peak of memory in this process
    disk_bytes : size of all files
    runs : variables of which every value takes runs of the pipeline's stages, with the reason
    """

    designs: int
    pieces: int
    speeds: int
    seconds: float
    memory_bytes: float
    disk_bytes: float
    runs: dict[str, str]

    @property
    def text(self) -> str:
        """One line."""
        of_runs = f"; by runs: {', '.join(self.runs)}" if self.runs else ""
        return (
            f"{self.designs} designs, {self.pieces} pieces at {self.speeds} speeds: about "
            f"{duration(self.seconds)} after the start, "
            f"{self.memory_bytes / 1e6:.3g} MB of memory, "
            f"{self.disk_bytes / 1e6:.3g} MB on disk{of_runs}"
        )


class _Written(NamedTuple):
    """Size of a design in files: time, s, and bytes of the table and of compressed values."""

    seconds: float
    row_bytes: float
    value_bytes: float


def check_size(problem: Problem, count: int) -> None:
    """Refuse a sweep that takes more memory than a result may, or than is available."""
    needed = memory_bytes(problem, count) - process_bytes()
    available = psutil.virtual_memory().available
    _refuse_above(problem, count, "result", _result_bytes(problem, count), MOST_BYTES)
    _refuse_above(problem, count, "evaluation", needed, available)


def _refuse_above(problem: Problem, count: int, what: str, size: float, limit: float) -> None:
    if size > limit:
        raise ParameterError(
            f"{problem.study.source_file}: design: the {what} of {count} designs takes "
            f"{size / 2**30:.1f} GiB; allowed {limit / 2**30:.3g} GiB: take fewer points, "
            "samples, objectives or workers"
        )


def _result_bytes(problem: Problem, count: int) -> int:
    """Bytes of the values of all designs in memory; those of a sample with their variables."""
    variables = 0 if problem.design.sampling == "grid" else len(problem.space.variables)
    return count * (8 * len(problem.wanted) + 5 + 8 * variables)


def memory_bytes(problem: Problem, count: int) -> float:
    """Memory of this process at the peak of a sweep, with all copies.

    A sample is copied as its variables are labelled; tables are written block by block.
    """
    variables = 0 if problem.design.sampling == "grid" else len(problem.space.variables)
    copies = 8 * count * variables
    return process_bytes() + _work_bytes(count) + _result_bytes(problem, count) + copies


def _work_bytes(count: int) -> float:
    """Memory of blocks in work and of the report: less where there are few designs."""
    return _REPORT_MEMORY_BYTES + _BLOCK_BYTES * min(count / BLOCK, 1.0)


def planned(
    problem: Problem, listing: Listing, longest_s: float = LONGEST_S, workers: int = 0
) -> Plan:
    """Plan a sweep from some of its pieces.

    Parameters
    ----------
    problem : problem of the study
    listing : its designs
    longest_s : longest time that it may take
    workers : further processes that evaluate; with none this one does

    Raises
    ------
    ParameterError
        It takes longer, or all processes together take more memory than is available.
    """
    count, samples = listing.count, problem.samples()
    routes = [problem.engine.routes(option) for option in problem.space.options]
    runs = {key: r.reason for each in routes for key, r in each.items() if not r.linear}
    runs.pop(OPTION, None)
    trial = tried(problem, listing)
    written = _written(problem, trial)
    of_all = trial.seconds / workers if workers else max(trial.seconds - trial.spent_s, 0.0)
    seconds = of_all + trial.seconds * _further_share(problem, count)
    seconds += count * written.seconds + _report_s(problem, count)
    rows = count + _REPORT_ROW * min(count, MOST_SHOWN)
    disk = rows * written.row_bytes + count * written.value_bytes + _REPORT_BYTES
    growth = min(trial.kept_bytes, MOST_KEPT_BYTES)
    here = memory_bytes(problem, count) + (0.0 if workers else growth)
    plan = Plan(
        count,
        count * problem.weight(samples).size,
        len(problem.study.operation.speed_rpm),
        seconds,
        here,
        disk,
        runs,
    )
    further = here - process_bytes() + workers * (process_bytes() + growth)
    _refuse_above(problem, count, "evaluation", further, psutil.virtual_memory().available)
    if seconds > longest_s:
        raise ParameterError(
            f"{problem.study.source_file}: design: {plan.text}; allowed {duration(longest_s)}"
        )
    return plan


def _report_s(problem: Problem, count: int) -> float:
    """Processor time of the report and its tables."""
    seconds = _REPORT_S + _SHOWN_S * min(count, MOST_SHOWN)
    if count > MOST_SHOWN:
        seconds += _SELECTED_S + _SORTED_S * count
    if problem.design.sampling != "grid":
        seconds += _LABELLED_S * count * len(problem.space.variables)
    return seconds


def _written(problem: Problem, trial: Trial) -> _Written:
    """Write a few designs to memory as a sweep writes them: text, bytes and compressed bytes."""
    rows = slice(min(len(trial.designs), _WRITTEN))
    values = np.concatenate([trial.evaluation.objectives, trial.evaluation.constraints], axis=1)
    begin = time.process_time()
    each = zip(problem.space.variables, trial.designs[rows].T, strict=True)
    columns = [variable.in_file(column) for variable, column in each]
    text = "\n".join(map(",".join, zip(*map(cells, [*columns, *values[rows].T]), strict=True)))
    no_failures = json.dumps([""] * len(values[rows])).encode()
    packed = [values[rows].tobytes(), no_failures, _compressed(values[rows])]
    if problem.design.sampling != "grid":
        packed.append(_compressed(trial.designs[rows]))
    seconds, count = time.process_time() - begin, len(values[rows])
    return _Written(
        seconds / count, len(text) / count + _FURTHER_BYTES, sum(map(len, packed)) / count
    )


def _compressed(values: Array) -> bytes:
    """Compress values as a file of results does: byte by byte of the numbers."""
    return zlib.compress(values.T.reshape(-1, 1).view(np.uint8).T.tobytes(), 4)


def _further_share(problem: Problem, count: int) -> float:
    """Work of the report over that of the sweep: fresh pieces of the best, and spread designs."""
    search, samples = problem.design.search, len(problem.samples())
    runs = set(problem.run_columns)
    scattered = {scatter.column for scatter in problem.pieces.scatters}
    if not runs:
        fresh = search.best * search.fresh_samples * bool(scattered)
        spread = SPREAD_DESIGNS * (1.0 + len(problem.total_changes()))
        return (fresh / samples + spread) / count
    return search.best * (search.fresh_samples if runs & scattered else 1.0) / count


def process_bytes() -> int:
    """Return the memory of this process."""
    return int(psutil.Process().memory_info().rss)


def duration(seconds: float) -> str:
    """A duration in words."""
    if seconds < 120.0:
        return f"{seconds:.2g} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"
