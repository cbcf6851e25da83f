"""What a sweep will take, before it starts."""

import time
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..results.size import MOST_BYTES
from .problem import Problem
from .space import OPTION

LONGEST_S: Final = 12 * 3600.0
"""That a sweep takes unless more is allowed."""
MOST_TRIED: Final = 4096
"""Pieces whose time tells that of all."""
TRIED_RUNS: Final = 4
CELL_BYTES: Final = 20
"""Of a number in a table."""


@dataclass(frozen=True)
class Plan:
    """Size of a sweep.

    Attributes
    ----------
    designs, pieces : number of them; a piece is a design with a sample of its tolerances
    speeds : number of them
    seconds : expected
    result_bytes : in memory
    table_bytes : of the CSV
    runs : variables of which every value takes runs of the pipeline's stages, with the reason
    """

    designs: int
    pieces: int
    speeds: int
    seconds: float
    result_bytes: int
    table_bytes: int
    runs: dict[str, str]

    @property
    def text(self) -> str:
        """One line."""
        of_runs = f"; by runs: {', '.join(self.runs)}" if self.runs else ""
        return (
            f"{self.designs} designs, {self.pieces} pieces at {self.speeds} speeds: about "
            f"{duration(self.seconds)}, result {self.result_bytes / 1e6:.3g} MB, table "
            f"{self.table_bytes / 1e6:.3g} MB{of_runs}"
        )


def check_size(problem: Problem, count: int) -> None:
    """Refuse a sweep whose result is too large.

    Raises
    ------
    ParameterError
        It would take more than 2 GiB.
    """
    size = result_bytes(problem, count)
    if size > MOST_BYTES:
        raise ParameterError(
            f"{problem.study.source_file}: design: the result of {count} designs takes "
            f"{size / 2**30:.1f} GiB; allowed 2 GiB: take fewer points, samples or objectives"
        )


def result_bytes(problem: Problem, count: int) -> int:
    """Bytes in memory of a sweep's result, twice, as it is put together."""
    return 16 * count * (len(problem.space.variables) + len(problem.wanted) + 2)


def planned(problem: Problem, designs: Array, longest_s: float = LONGEST_S) -> Plan:
    """What a sweep will take, known from some of its designs.

    Parameters
    ----------
    problem : of the study
    designs : all of them, shape (design, variable)
    longest_s : refused above

    Raises
    ------
    ParameterError
        It takes longer.
    """
    count, samples = len(designs), problem.samples()
    routes = [problem.engine.routes(option) for option in problem.space.options]
    runs = {key: r.reason for each in routes for key, r in each.items() if not r.linear}
    runs.pop(OPTION, None)
    if runs:
        seconds = _run_seconds(problem, designs) * _number_of_runs(problem, designs, list(runs))
    else:
        seconds = _seconds(problem, designs, samples)
    columns = len(problem.space.variables) + len(problem.wanted) + 2
    plan = Plan(
        count,
        count * problem.weight(samples).size,
        len(problem.study.operation.speed_rpm),
        seconds,
        result_bytes(problem, count),
        CELL_BYTES * columns * count,
        runs,
    )
    if seconds > longest_s:
        raise ParameterError(
            f"{problem.study.source_file}: design: {plan.text}; allowed {duration(longest_s)}"
        )
    return plan


def _seconds(problem: Problem, designs: Array, samples: Array) -> float:
    """Of all designs by linear algebra, from those of some."""
    tried = max(MOST_TRIED // len(samples), 1)
    rows = np.linspace(0, len(designs) - 1, min(tried, len(designs))).astype(int)
    problem.evaluate(designs[rows[:1]], samples[:1])  # what is made once
    begin = time.perf_counter()
    problem.evaluate(designs[rows], samples)
    return (time.perf_counter() - begin) * len(designs) / len(rows)


def _run_seconds(problem: Problem, designs: Array) -> float:
    """Of one design by a run."""
    rows = np.linspace(0, len(designs) - 1, min(TRIED_RUNS, len(designs))).astype(int)
    sample = np.full((1, len(problem.pieces.scatters)), 0.5)
    problem.evaluate(designs[rows[:1]], sample)
    begin = time.perf_counter()
    problem.evaluate(designs[rows[1:]], sample)
    return (time.perf_counter() - begin) / max(len(rows) - 1, 1)


def _number_of_runs(problem: Problem, designs: Array, keys: list[str]) -> int:
    """Different designs, and pieces where tolerances scatter what takes runs."""
    names = problem.pieces.wide.names
    columns = [names.index(key) for key in keys]
    varied = [column for column in columns if column < designs.shape[1]]
    different = len(np.unique(designs[:, varied], axis=0)) if varied else 1
    scattered = {scatter.column for scatter in problem.pieces.scatters} & set(columns)
    return len(designs) * len(problem.samples()) if scattered else different


def duration(seconds: float) -> str:
    """A duration in words."""
    if seconds < 120.0:
        return f"{seconds:.2g} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"
