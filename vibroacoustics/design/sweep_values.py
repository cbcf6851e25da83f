"""Designs of a grid or a sample, made block by block, and results of a sweep as they come in."""

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..base.arrays import Array, IndexArray
from .evaluation import Evaluation
from .explaining import apart
from .problem import Problem
from .search.front import nondominated
from .search.problem import Searched
from .search_dataset import machine_words

BLOCK: Final = 131_072
"""Designs that are listed at a time."""


@dataclass(frozen=True)
class Listing:
    """Designs of a sweep.

    Attributes
    ----------
    count : number of designs
    designs : function that gives the designs of some numbers, shape (design, variable), SI
    ordered : function that gives the numbers at some positions of the order of evaluation
    """

    count: int
    designs: Callable[[IndexArray], Array]
    ordered: Callable[[IndexArray], IndexArray]

    def blocks(self) -> Iterator[IndexArray]:
        """Give all numbers, block by block, in their order."""
        for first in range(0, self.count, BLOCK):
            yield np.arange(first, min(first + BLOCK, self.count), dtype=np.intp)


def listed_grid(axes: Sequence[Array], slow: Sequence[int]) -> Listing:
    """List all combinations of values, numbered with the last variable fastest.

    Parameters
    ----------
    axes : values of each variable
    slow : numbers of the variables that vary slowest in the order of evaluation
    """
    shape = tuple(axis.size for axis in axes)
    order = [*slow, *(number for number in range(len(axes)) if number not in slow)]

    def designs(numbers: IndexArray) -> Array:
        indices = np.unravel_index(numbers, shape)
        return np.stack([axis[n] for axis, n in zip(axes, indices, strict=True)], axis=1)

    def ordered(positions: IndexArray) -> IndexArray:
        indices = dict(zip(order, np.unravel_index(positions, [shape[n] for n in order]),
                          strict=True))  # fmt: skip
        return np.ravel_multi_index([indices[n] for n in range(len(shape))], shape)

    return Listing(int(np.prod(shape)), designs, ordered)


def listed_sample(designs: Array, slow: Sequence[int]) -> Listing:
    """List the designs of a sample.

    Parameters
    ----------
    designs : shape (design, variable), SI
    slow : numbers of the variables that vary slowest in the order of evaluation
    """
    order = np.lexsort(designs[:, slow[::-1]].T) if slow else None
    return Listing(
        len(designs), designs.__getitem__, (lambda n: n) if order is None else order.__getitem__
    )


MOST_SHOWN: Final = 100_000
"""Designs of a sweep that its report shows."""
_FEW: Final = 32
"""Designs of a front that sort most others out."""


class SweepValues:
    """Values of all designs of a sweep.

    Parameters
    ----------
    problem : problem that is swept
    listing : its designs
    """

    def __init__(self, problem: Problem, listing: Listing) -> None:
        self._problem, self._listing = problem, listing
        self.values: Array = np.full((len(problem.wanted), listing.count), np.nan)
        """Every objective and constraint in its unit, shape (wanted, design)."""
        self.feasible = np.zeros(listing.count, dtype=np.int8)
        """1 where a design keeps to all constraints, shape (design,)."""
        self.failure = np.zeros(listing.count, dtype=np.int32)
        """Number of the reason why a design failed, 0 where it did not, shape (design,)."""
        self.reasons: list[str] = []
        """Reasons why designs failed."""

    def take(self, numbers: IndexArray, evaluation: Evaluation) -> None:
        """Take in the evaluation of the designs of some numbers."""
        values = self._problem.in_units(evaluation.objectives, evaluation.constraints)
        self.values[:, numbers] = values.T
        met = (evaluation.constraints <= 0.0).all(axis=1) & np.isfinite(values).all(axis=1)
        self.feasible[numbers] = met
        for row, reason in enumerate(evaluation.failures):
            if reason:
                if reason not in self.reasons:
                    self.reasons.append(reason)
                self.failure[numbers[row]] = 1 + self.reasons.index(reason)

    @property
    def failed(self) -> int:
        """Number of designs that failed."""
        return int(np.count_nonzero(self.failure))

    def evaluation(self, numbers: IndexArray) -> Evaluation:
        """Return the evaluation of the designs of some numbers."""
        judged = self._problem.judged(self.values[:, numbers].T, {})
        reasons = ["", *self.reasons]
        failures = tuple(reasons[number] for number in self.failure[numbers].tolist())
        return Evaluation(judged.objectives, judged.constraints, failures)

    def searched(self, best: int) -> Searched:
        """Return the designs that a report shows, as those of a search with one generation.

        They are all designs, or the front or the best few and others at even distances.

        Parameters
        ----------
        best : number of designs that are the best by one objective
        """
        count = self._listing.count
        numbers = np.arange(count)
        if count > MOST_SHOWN:
            single = len(self._problem.design.objectives) == 1
            chosen = self._best(best) if single else self._front()
            even = np.linspace(0, count - 1, MOST_SHOWN).astype(np.intp)
            numbers = np.unique(np.concatenate([chosen, even]))
        return Searched(
            self._listing.designs(numbers),
            self.evaluation(numbers),
            np.zeros(len(numbers), np.intp),
        )

    def attributes(self, words: str) -> dict[str, Any]:
        """Return attributes of the dataset of the designs that a report shows.

        Parameters
        ----------
        words : how designs were chosen
        """
        counts = np.bincount(self.failure, minlength=1 + len(self.reasons))[1:].tolist()
        reasons = sorted(zip(self.reasons, counts, strict=True), key=lambda pair: -pair[1])
        return {
            "evaluated": self._listing.count,
            "allowed": int(self.feasible.sum(dtype=np.int64)),
            "failures": json.dumps(reasons[:20]),
            "method": f"{words}: {self._listing.count} designs. {machine_words(self._problem)}",
        }

    def _best(self, count: int) -> IndexArray:
        """Numbers of the best designs by the objective, each apart from those before it."""
        chosen: list[int] = []
        sign, limits = self._problem.signs[0][0], self._problem.space.limits
        near = np.zeros(self._listing.count, dtype=bool)
        for _ in range(count):
            least = [self._least(numbers, near, sign) for numbers in self._listing.blocks()]
            value, number = min(least)
            if not np.isfinite(value):
                break
            chosen.append(number)
            design = self._listing.designs(np.array([number]))
            for numbers in self._listing.blocks():
                near[numbers] |= ~apart(self._listing.designs(numbers), design, limits)
        return np.array(chosen, dtype=np.intp)

    def _least(self, numbers: IndexArray, near: Any, sign: float) -> tuple[float, int]:
        """Least objective of allowed designs that are not near, and its number."""
        allowed = (self.feasible[numbers] == 1) & ~near[numbers]
        values = np.where(allowed, sign * self.values[0, numbers], np.inf)
        row = int(np.argmin(values))
        return float(values[row]), int(numbers[row])

    def _front(self) -> IndexArray:
        """Numbers of the allowed designs that no other is better than in every objective."""
        front: IndexArray = np.empty(0, np.intp)
        objectives: Array = np.empty((0, len(self._problem.design.objectives)))
        for numbers in self._listing.blocks():
            allowed = numbers[self.feasible[numbers] == 1]
            new = self.evaluation(allowed).objectives
            few = objectives[np.linspace(0, len(front) - 1, min(_FEW, len(front))).astype(int)]
            is_open = np.ones(len(new), dtype=bool)
            for row in few:
                is_open &= ~((row <= new).all(axis=1) & (row < new).any(axis=1))
            front = np.concatenate([front, allowed[is_open]])
            objectives = np.concatenate([objectives, new[is_open]])
            kept = nondominated(objectives)
            front, objectives = front[kept], objectives[kept]
        return front
