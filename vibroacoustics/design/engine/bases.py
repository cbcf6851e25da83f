"""Functions of a variable in which loads and matrices may be linear."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array

Functions = Callable[[Array, float], Array]
"""Of values, shape (design, variable), and speed in rpm to functions, shape (design, function)."""


@dataclass(frozen=True)
class Basis:
    """Functions of one variable, or of some together, beside the constant one.

    Attributes
    ----------
    name : in words
    variables : their numbers
    functions : of the values of all variables
    size : number of functions
    by_speed : whether they differ from speed to speed
    """

    name: str
    variables: tuple[int, ...]
    functions: Functions
    size: int
    by_speed: bool = False

    def at(self, values: Array, speed_rpm: float) -> Array:
        """Functions of designs, shape (design, function)."""
        return self.functions(values[:, self.variables], speed_rpm)


def bases_of(variable: int, low: float, high: float) -> list[Basis]:
    """Bases of one variable, in the order in which they are tried.

    Parameters
    ----------
    variable : its number
    low, high : limits of its values
    """

    def unit(values: Array) -> Array:
        return (2.0 * values[:, 0] - low - high) / (high - low)

    def powers(count: int) -> Functions:
        return lambda values, _: unit(values)[:, None] ** np.arange(1, count + 1)

    def turning(values: Array, _: float) -> Array:
        turned = values[:, 0] - 0.5 * (low + high)
        return np.stack([np.sin(turned), np.cos(turned)], axis=1)

    def inverse(values: Array, _: float) -> Array:
        return np.stack([unit(values), low / values[:, 0]], axis=1)

    named: Mapping[str, tuple[Functions, int]] = {
        "linear": (powers(1), 1),
        "quadratic": (powers(2), 2),
        "an angle": (turning, 2),
        "inverse": (inverse, 2),
        "cubic": (powers(3), 3),
    }
    return [
        Basis(name, (variable,), functions, size)
        for name, (functions, size) in named.items()
        if name != "inverse" or low > 0.0
    ]
