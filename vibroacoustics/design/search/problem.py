"""A problem of design as arrays: bounds, what is whole-numbered, and what evaluates it."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.arrays import Array, IndexArray
from ...base.errors import SolverError
from ..evaluation import Evaluate, Evaluation, joined


@dataclass(frozen=True)
class SearchProblem:
    """Problem of a search: bounds, integers and evaluation.

    Attributes
    ----------
    lower, upper : bounds of the variables, shape (variable,)
    integer : variables that take whole numbers only (choices by their number), shape (variable,)
    evaluate : function that evaluates a batch of designs
    """

    lower: Array
    upper: Array
    integer: npt.NDArray[np.bool_]
    evaluate: Evaluate

    def at_shares(self, shares: Array) -> Array:
        """Return designs at shares of the ranges, shape (..., variable).

        Each integer has an equal part of its range.
        """
        span = self.upper - self.lower
        steps = np.minimum(np.floor(shares * (span + 1.0)), span)
        return np.asarray(self.lower + np.where(self.integer, steps, shares * span))

    def shares(self, designs: Array) -> Array:
        """Return designs as shares of the ranges, shape (..., variable).

        An integer is in the middle of its part.
        """
        span = np.maximum(self.upper - self.lower, np.finfo(float).tiny)
        away = designs - self.lower
        return np.where(self.integer, (away + 0.5) / (span + 1.0), away / span)


@dataclass(frozen=True)
class Searched:
    """All designs that a search evaluated, in its order.

    Attributes
    ----------
    designs : shape (design, variable)
    evaluation : evaluation of each design
    generation : generation in which each was evaluated, from 0, shape (design,)
    """

    designs: Array
    evaluation: Evaluation
    generation: IndexArray

    @property
    def any_allowed(self) -> bool:
        """Whether a design meets every constraint."""
        return bool((self.evaluation.violation <= 0.0).any())

    @property
    def best(self) -> int:
        """Row of the best design by the first objective.

        Raises
        ------
        SolverError
            None meets the constraints.
        """
        violation = self.evaluation.violation
        if not self.any_allowed:
            least = float(violation.min())
            raise SolverError(
                f"design: none of {len(self.designs)} designs meets the constraints "
                f"(least sum of excesses: {least:.3g})"
            )
        return int(np.argmin(np.where(violation <= 0.0, self.evaluation.objectives[:, 0], np.inf)))


class History:
    """Keeps what a search asks for, generation by generation."""

    def __init__(self, evaluate: Evaluate) -> None:
        self._evaluate = evaluate
        self._designs: list[Array] = []
        self._evaluations: list[Evaluation] = []

    def __call__(self, designs: Array) -> Evaluation:
        """Evaluate a generation."""
        evaluation = self._evaluate(designs)
        self._designs.append(designs.copy())
        self._evaluations.append(evaluation)
        return evaluation

    def ask(self, evaluate: Evaluate) -> None:
        """Ask another from now on."""
        self._evaluate = evaluate

    def searched(self) -> Searched:
        """All so far."""
        sizes = [len(designs) for designs in self._designs]
        return Searched(
            np.concatenate(self._designs),
            joined(self._evaluations),
            np.repeat(np.arange(len(sizes)), sizes),
        )
