"""Expected time, memory and disk space of a sweep, before it starts."""

import time
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
import psutil

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..results.size import MOST_BYTES
from .dataset import DIGITS
from .engine.machine_sample import KEPT
from .evaluation import Evaluation, evaluating, joined
from .explaining import SPREAD_DESIGNS
from .listing import BLOCK, Listing
from .problem import Problem
from .space import OPTION
from .sweep_values import MOST_SHOWN

LONGEST_S: Final = 12 * 3600.0
"""Longest time of a sweep unless more is allowed."""
_STARTS, _CONSECUTIVE = 3, 4
"""Numbers of pieces from which some are timed, and how many that follow each other."""
_TRIED_S: Final = 2.0
"""Processor time after which no further piece is timed there."""
_WRITTEN: Final = 2_000
"""Designs that are written to see how large they are."""
_FURTHER_BYTES: Final = 5.0
"""Bytes of a row of the table: whether a design is allowed, and ends of cells."""
_REPORT_S, _SHOWN_S = 0.3, 5e-6
"""Processor time of a report, and of each design that it shows."""
_SELECTED_S, _SORTED_S = 1.0, 3e-7
"""Processor time of the selection of designs for a report, and of each of very many designs."""
_LABELLED_S: Final = 3e-7
"""Processor time of the value of a variable in a sample."""
_REPORT_BYTES: Final = 230_000
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
            f"{duration(self.seconds)}, {self.memory_bytes / 1e6:.3g} MB of memory, "
            f"{self.disk_bytes / 1e6:.3g} MB on disk{of_runs}"
        )


class _Tried(NamedTuple):
    """Pieces that were timed.

    Attributes
    ----------
    designs : shape (design, variable), SI
    evaluation : evaluation of the designs
    pieces : number of them
    seconds : processor time of all of them
    share : share of the work of the sweep
    kept_bytes : memory that results of runs keep of each
    """

    designs: Array
    evaluation: Evaluation
    pieces: int
    seconds: float
    share: float
    kept_bytes: float


class _Written(NamedTuple):
    """Size of a design in files: time, s, and bytes of the table and of compressed values."""

    seconds: float
    row_bytes: float
    value_bytes: float


def check_size(problem: Problem, count: int) -> None:
    """Refuse a sweep that takes more memory than a result may, or than is available.

    Raises
    ------
    ParameterError
        Its result takes more than 2 GiB, or all copies more than the available memory.
    """
    result, needed = _result_bytes(problem, count), memory_bytes(problem, count)
    available = psutil.virtual_memory().available
    for what, size, limit in (
        ("result", result, MOST_BYTES),
        ("evaluation", needed - _memory_bytes(), available),
    ):
        if size > limit:
            raise ParameterError(
                f"{problem.study.source_file}: design: the {what} of {count} designs takes "
                f"{size / 2**30:.1f} GiB; allowed {limit / 2**30:.3g} GiB: take fewer points, "
                "samples or objectives"
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
    return _memory_bytes() + _work_bytes(count) + _result_bytes(problem, count) + copies


def _work_bytes(count: int) -> float:
    """Memory of blocks in work and of the report: less where there are few designs."""
    return _REPORT_MEMORY_BYTES + _BLOCK_BYTES * min(count / BLOCK, 1.0)


def planned(
    problem: Problem, listing: Listing, longest_s: float = LONGEST_S, workers: int = 1
) -> Plan:
    """Plan a sweep from some of its pieces.

    Parameters
    ----------
    problem : problem of the study
    listing : its designs
    longest_s : longest time that it may take
    workers : processes that evaluate

    Raises
    ------
    ParameterError
        It takes longer.
    """
    count, samples = listing.count, problem.samples()
    routes = [problem.engine.routes(option) for option in problem.space.options]
    runs = {key: r.reason for each in routes for key, r in each.items() if not r.linear}
    runs.pop(OPTION, None)
    tried = _tried(problem, listing)
    written = _written(problem, tried)
    of_all, pieces = tried.seconds / tried.share, tried.pieces / tried.share
    repeated = tried.share if runs and workers == 1 else 0.0  # results of runs are kept
    seconds = of_all * ((1.0 - repeated) / workers + _further_share(problem, count))
    seconds += count * written.seconds + _report_s(problem, count)
    rows = count + _REPORT_ROW * min(count, MOST_SHOWN)
    disk = rows * written.row_bytes + count * written.value_bytes + _REPORT_BYTES
    growth = tried.kept_bytes * max(min(pieces, KEPT) - tried.pieces, 0.0)
    plan = Plan(
        count,
        count * problem.weight(samples).size,
        len(problem.study.operation.speed_rpm),
        seconds,
        memory_bytes(problem, count) + growth,
        disk,
        runs,
    )
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


def _tried(problem: Problem, listing: Listing) -> _Tried:
    """Evaluate some pieces that follow each other at the begin, in the middle and at the end.

    Pieces that follow each other share results. What is made once is not timed.
    """
    evaluate, blocks = evaluating(problem), list(listing.blocks())
    some = [blocks[n] for n in sorted({0, len(blocks) // 2, len(blocks) - 1})]
    blocks_of_designs = (listing.designs(listing.ordered(block)) for block in some)
    pieces = [piece for each in blocks_of_designs for piece in problem.splitting.pieces(each)]
    evaluate(pieces[0][:1])
    parts, seconds, before = [], 0.0, _memory_bytes()
    for numbers in np.array_split(np.arange(len(pieces)), min(_STARTS, len(pieces))):
        begin = time.process_time()
        for number in numbers[:_CONSECUTIVE].tolist():
            parts.append((pieces[number], evaluate(pieces[number])))
            if time.process_time() - begin > _TRIED_S:
                break
        seconds += time.process_time() - begin
    designs = np.concatenate([piece for piece, _ in parts])
    share, kept = len(designs) / listing.count, 0.0
    if problem.run_columns:
        kept = (_memory_bytes() - before) / len(parts)
        share = len(parts) / len(pieces) * sum(block.size for block in some) / listing.count
    evaluation = joined([evaluation for _, evaluation in parts])
    return _Tried(designs, evaluation, len(parts), seconds, share, kept)


def _memory_bytes() -> int:
    """Memory of this process."""
    return int(psutil.Process().memory_info().rss)


def _written(problem: Problem, tried: _Tried) -> _Written:
    """Write a few designs to memory as a sweep writes them: text, bytes and compressed bytes."""
    rows = slice(min(len(tried.designs), _WRITTEN))
    variables = problem.space.variables
    cells = [[v.written(x) for v, x in zip(variables, design, strict=True)]
             for design in tried.designs[rows].tolist()]  # fmt: skip
    values = np.concatenate([tried.evaluation.objectives, tried.evaluation.constraints], axis=1)
    begin = time.process_time()
    columns = [*zip(*cells, strict=True), *values[rows].T.tolist()]
    text = "\n".join(map(",".join, zip(*map(_text, columns), strict=True)))
    shuffled = values[rows].T.reshape(-1, 1).view(np.uint8).T.tobytes()
    packed = [shuffled, zlib.compress(shuffled, 4)]
    seconds, count = time.process_time() - begin, len(cells)
    return _Written(
        seconds / count, len(text) / count + _FURTHER_BYTES, sum(map(len, packed)) / count
    )


def _text(column: Sequence[str | float]) -> Iterator[str]:
    return map(str if isinstance(column[0], str) else DIGITS.format, column)


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


def duration(seconds: float) -> str:
    """A duration in words."""
    if seconds < 120.0:
        return f"{seconds:.2g} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"
