"""Evaluation of designs as a function of arrays, so that any search can use it."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.linear_algebra import one_thread_of_linear_algebra

if TYPE_CHECKING:
    from .problem import Problem


@dataclass(frozen=True)
class Evaluation:
    """Evaluated designs.

    Attributes
    ----------
    objectives : each the better the less, shape (design, objective); not a number where it failed
    constraints : each met where it is at most 0, shape (design, constraint)
    failures : why a design failed, a line for each design; empty where it did not
    """

    objectives: Array
    constraints: Array
    failures: tuple[str, ...]

    def some(self, rows: IndexArray) -> "Evaluation":
        """Return the evaluation of some designs."""
        failures = tuple(self.failures[row] for row in rows.tolist())
        return Evaluation(self.objectives[rows], self.constraints[rows], failures)

    @property
    def violation(self) -> Array:
        """Sum of what constraints are exceeded by, shape (design,); infinite where it failed."""
        exceeded = np.maximum(self.constraints, 0.0).sum(axis=1)
        return np.where(np.isfinite(self.objectives).all(axis=1), exceeded, np.inf)


Evaluate = Callable[[Array], Evaluation]
"""Takes designs, shape (design, variable)."""
Stream = Callable[[Iterable[Array]], Iterator[Evaluation]]
"""Takes pieces of designs; gives the evaluation of each, in their order."""


def joined(parts: list[Evaluation]) -> Evaluation:
    """Evaluations of several batches of designs, one after another."""
    return Evaluation(
        np.concatenate([part.objectives for part in parts]),
        np.concatenate([part.constraints for part in parts]),
        tuple(reason for part in parts for reason in part.failures),
    )


def evaluating(problem: "Problem") -> Evaluate:
    """Return the evaluation of designs in SI in this process.

    Designs with a column more have there the number of a run of an active search, with scatter of
    its own.
    """
    columns = len(problem.space.variables)

    def of_samples(designs: Array, samples: Array | None) -> Evaluation:
        judged = problem.evaluate(designs, samples)
        reasons = tuple(judged.failed.get(row, "") for row in range(len(designs)))
        return Evaluation(judged.objectives, judged.constraints, reasons)

    def evaluate(designs: Array) -> Evaluation:
        with one_thread_of_linear_algebra():
            if designs.shape[1] == columns:
                return of_samples(designs, None)
            runs = np.rint(designs[:, columns]).astype(int).tolist()
            each = zip(designs[:, None, :columns], runs, strict=True)
            return joined([of_samples(row, problem.samples_of_run(run)) for row, run in each])

    return evaluate


def one_by_one(problem: "Problem") -> Stream:
    """Return what evaluates pieces in this process, one after another."""
    return partial(map, evaluating(problem))


def in_pieces(problem: "Problem", stream: Stream) -> Evaluate:
    """Return the evaluation of designs in SI by what evaluates pieces."""
    return lambda designs: joined(list(stream(problem.splitting.pieces(designs))))
