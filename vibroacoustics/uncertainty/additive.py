"""Additive polynomials through draws: what each unknown adds to a quantity.

Legendre polynomials of single unknowns, up to a degree, are taken into a least-squares fit one
after another, that first which lowers the leave-one-out error most. None is taken that lowers it
no more than the best of so many columns of chance would, by 2 ln(columns) / draws of itself
(Foster and George 1994, Annals of Statistics 22, 1947).
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray

HIGHEST_DEGREE: Final = 6
FOLDS: Final = 10
_NOTHING: Final = 1e-6
"""Of a column's size: what is left of one that others already make up."""


@dataclass(frozen=True)
class Fit:
    """Columns of a fit and their factors.

    Attributes
    ----------
    column : their numbers among those of `legendre_columns`
    factor : of each
    constant : what is added
    """

    column: IndexArray
    factor: Array
    constant: float

    def at(self, columns: Array) -> Array:
        """Its values where the columns are given, shape (draw,)."""
        return np.asarray(columns[:, self.column] @ self.factor + self.constant)

    def effects(self, columns: Array) -> Array:
        """What each unknown adds, shape (draw, unknown)."""
        count = columns.shape[1] // HIGHEST_DEGREE
        owner = self.column[:, None] // HIGHEST_DEGREE == np.arange(count)
        return np.asarray((columns[:, self.column] * self.factor) @ owner)


def legendre_columns(unit: Array) -> Array:
    """Legendre polynomials of degree 1 up of each unknown, shape (draw, unknown and degree).

    Parameters
    ----------
    unit : unknowns from -1 to 1, shape (draw, unknown)
    """
    polynomials = np.polynomial.legendre.legvander(unit, HIGHEST_DEGREE)[..., 1:]
    return np.asarray(polynomials.reshape(len(unit), -1))


def additive_fit(columns: Array, value: Array, weight: Array, chances: int) -> Fit:
    """The fit of columns chosen by their leave-one-out error.

    Parameters
    ----------
    columns : shape (draw, column)
    value : shape (draw,)
    weight : above zero, shape (draw,)
    chances : number of columns that the best of chance is taken of
    """
    root = np.sqrt(weight / weight.mean())
    penalty = 2.0 * np.log(max(chances, 2)) * (weight**2).sum() / weight.sum() ** 2
    chosen = _chosen(columns * root[:, None], value * root, root, penalty)
    basis = np.column_stack([np.ones(len(value)), columns[:, chosen]])
    solution = np.linalg.lstsq(basis * root[:, None], value * root, rcond=None)[0]
    return Fit(np.array(chosen, dtype=np.intp), solution[1:], float(solution[0]))


def quality(columns: Array, value: Array, weight: Array) -> float:
    """Q²: share of the variance of draws that fits without them foretell, at best 1.

    The columns are chosen anew each time, as their choice fits to chance too. None, as not a
    number, where the value does not vary.

    Parameters
    ----------
    columns, value, weight : as of `additive_fit`
    """
    foretold, fold = np.zeros(len(value)), np.arange(len(value)) % FOLDS
    for number in range(FOLDS):
        rest = fold != number
        fit = additive_fit(columns[rest], value[rest], weight[rest], columns.shape[1])
        foretold[~rest] = fit.at(columns[~rest])
    spread = np.average((value - np.average(value, weights=weight)) ** 2, weights=weight)
    if spread <= 0.0:
        return float("nan")
    return float(1.0 - np.average((value - foretold) ** 2, weights=weight) / spread)


def _chosen(columns: Array, value: Array, constant: Array, penalty: float) -> list[int]:
    """Numbers of the columns, in the order in which they are taken."""
    first = constant / np.linalg.norm(constant)
    rest, leverage = value - first * (first @ value), first**2
    left = columns - np.outer(first, first @ columns)
    least = _NOTHING * np.linalg.norm(columns, axis=0)
    error = _left_out(rest, leverage)
    chosen: list[int] = []
    while len(chosen) < len(value) // 3:
        size = np.linalg.norm(left, axis=0)
        free = np.flatnonzero(size > least)
        if not free.size:
            break
        unit = left[:, free] / size[free]
        errors = _left_out(rest[:, None] - unit * (rest @ unit), leverage[:, None] + unit**2)
        best = int(np.argmin(errors))
        if not errors[best] < error * (1.0 - penalty):
            break
        direction, error = unit[:, best], errors[best]
        rest, leverage = rest - direction * (rest @ direction), leverage + direction**2
        left = left - np.outer(direction, direction @ left)
        chosen.append(int(free[best]))
    return chosen


def _left_out(rest: Array, leverage: Array) -> Array:
    """Sum of squares of what each draw is off a fit without it, by column."""
    return np.asarray(((rest / np.maximum(1.0 - leverage, _NOTHING)) ** 2).sum(axis=0))
