"""Shares of unknowns in the variance of a quantity, of first order, from weighed draws."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from .additive import HIGHEST_DEGREE, additive_fit, legendre_columns, quality

LEAST_DRAWS: Final = 16
"""Effective ones, from which anything can be told."""
MOST_DRAWS: Final = 1024
"""That are used, those of the largest weights; of many draws most hardly count."""

_ROUNDING: Final = 1e-6
"""A quantity that varies less does not vary."""


@dataclass(frozen=True)
class Shares:
    """Shares of first order, Var(E[quantity | unknown]) / Var(quantity).

    Attributes
    ----------
    share : shape (unknown,); not a number where there are too few draws
    quality : Q² of the additive fit that they come from, not a number likewise
    variance : of the quantity over the draws that count
    """

    share: Array
    quality: float
    variance: float


def shares_of(unit: Array, value: Array, weight: Array) -> Shares:
    """Shares of unknowns in the variance of a quantity over weighed draws.

    What an unknown adds itself, and what it tells of the others where weights have made them hang
    together. Of independent unknowns the first alone: Sobol's indices of first order.

    Parameters
    ----------
    unit : unknowns from -1 to 1, shape (draw, unknown)
    value : the quantity, shape (draw,); not a number where a draw has no solution
    weight : of the draws, shape (draw,)
    """
    counting = np.where(np.isfinite(value), weight, 0.0)
    used = np.argsort(-counting, kind="stable")[: min(np.count_nonzero(counting), MOST_DRAWS)]
    unit, value, weight = unit[used], value[used], weight[used]
    none = np.full(unit.shape[1], np.nan)
    if used.size == 0 or weight.sum() ** 2 / (weight**2).sum() < LEAST_DRAWS:
        return Shares(none, float("nan"), float("nan"))
    variance = float(_covariance(value, value, weight))
    if variance <= _ROUNDING**2:
        return Shares(none, float("nan"), variance)
    columns = legendre_columns(unit)
    fit = additive_fit(columns, value, weight, columns.shape[1])
    effects = fit.effects(columns)
    others = np.stack(
        [_of_others(columns, effects, weight, number) for number in range(unit.shape[1])], axis=1
    )
    # Chance makes effects of independent unknowns hang together: what is not told by `others` is 0.
    together = _covariance(effects, effects + others, weight).sum()
    spread = together + _covariance(rest := value - fit.at(columns), rest, weight)
    expected = effects + others
    share = _covariance(expected, expected, weight) / spread
    return Shares(share, quality(columns, value, weight), variance)


def _of_others(columns: Array, effects: Array, weight: Array, number: int) -> Array:
    """What an unknown tells of the effects of the others, shape (draw,)."""
    others = effects.sum(axis=1) - effects[:, number]
    alone = columns[:, number * HIGHEST_DEGREE : (number + 1) * HIGHEST_DEGREE]
    fit = additive_fit(alone, others, weight, columns.shape[1] ** 2)  # of all pairs
    return fit.at(alone)


def _covariance(first: Array, second: Array, weight: Array) -> Array:
    """Of weighed draws, along the first axis."""
    middle = np.average(first, axis=0, weights=weight)
    return np.asarray(np.average((first - middle) * second, axis=0, weights=weight))
