"""Loads and matrices of all designs as sums of products, exact where they pass the test."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from .terms import Terms

RELATIVE: Final = 1e-10
"""Error of a line or value that is rounding, of its largest size over the designs."""
NOTHING: Final = 1e-12
"""Part of the largest value of an array below which all is rounding."""
SAME: Final = 2e-13
"""Change, of the largest of an array, that is none."""

Stack = Mapping[str, ComplexArray]
"""Arrays of designs by name, shape (design, ...)."""


@dataclass(frozen=True)
class Expansion:
    """Arrays of every design as sums of products of functions of the variables.

    Attributes
    ----------
    terms : products of functions
    speed_rpm : speed of the arrays, rpm
    factors : factors by name of the array, shape (product, ...)
    """

    terms: Terms
    speed_rpm: float
    factors: Stack

    def arrays_of(self, values: Array) -> dict[str, ComplexArray]:
        """Compute arrays of designs (design, variable), shape (design, ...); (1, ...) if alike."""
        columns = self.terms.evaluate(values, self.speed_rpm)
        return {name: summed(columns, factors) for name, factors in self.factors.items()}

    def is_constant(self, name: str) -> bool:
        """Whether an array is the same for all designs."""
        return not self.factors[name][1:].any()


def summed(columns: Array, factors: ComplexArray) -> ComplexArray:
    """Sum over products, shape (design, ...); (1, ...) where only the constant one has a factor.

    Parameters
    ----------
    columns : products of the variables, shape (design, product)
    factors : factors of the products, shape (product, ...)
    """
    if not factors[1:].any():
        return factors[:1]
    flat = factors.reshape(len(factors), -1)
    varying = np.flatnonzero(flat[1:].any(axis=0))
    used = flat[:, varying].any(axis=1)
    real = columns[:, used] @ np.ascontiguousarray(flat[np.ix_(used, varying)]).view(float)
    result = np.repeat(flat[:1], len(columns), axis=0)
    result[:, varying] = real.view(complex)
    return result.reshape(len(columns), *factors.shape[1:])


def fitted(terms: Terms, speed_rpm: float, values: Array, arrays: Stack) -> Expansion:
    """Fit least squares through designs.

    Parameters
    ----------
    terms : products, fewer than designs
    speed_rpm : speed of the arrays, rpm
    values : values of the designs, shape (design, variable)
    arrays : arrays of these designs, shape (design, ...)
    """
    solve = np.linalg.pinv(terms.evaluate(values, speed_rpm), rcond=1e-14)
    factors: dict[str, ComplexArray] = {}
    for name, array in arrays.items():
        change = array - array[:1]
        unchanged = np.abs(change).max(axis=0) <= SAME * np.abs(array).max(initial=0.0)
        change[:, unchanged] = 0.0
        factor: ComplexArray = np.tensordot(solve, change, axes=(1, 0)).astype(complex)
        factor[0] += array[0]
        factors[name] = factor
    return Expansion(terms, speed_rpm, factors)


def deviation(expected: ComplexArray, computed: ComplexArray) -> float:
    """Return the largest error over the size of its line, both of shape (design, line, ...).

    The size of a line is its largest over designs and components, at least `NOTHING / RELATIVE`
    of the largest of the array, as smaller lines are rounding.
    """
    error = np.abs(computed - expected)
    if not error.any():
        return 0.0
    size = np.abs(expected)
    across = tuple(axis for axis in range(size.ndim) if axis != 1)
    floor = max(float(size.max()) * NOTHING / RELATIVE, 1e-300)
    return float(np.max(error / np.maximum(size.max(axis=across, keepdims=True), floor)))
