"""Functions of the variables, and their products."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...base.arrays import Array

Functions = Callable[[Array, float], Array]
"""Functions, shape (design, function), of values, shape (design, variable), and speed in rpm."""


@dataclass(frozen=True)
class Basis:
    """Functions of one variable, or of some together, beside the constant one.

    Attributes
    ----------
    name : description in words
    variables : numbers of the variables
    functions : functions of the values of these variables
    size : number of functions
    by_speed : whether they differ from speed to speed
    """

    name: str
    variables: tuple[int, ...]
    functions: Functions
    size: int
    by_speed: bool = False

    def evaluate(self, values: Array, speed_rpm: float) -> Array:
        """Evaluate the functions of designs, shape (design, function)."""
        return self.functions(values[:, self.variables], speed_rpm)


def bases_of(variable: int, low: float, high: float) -> list[Basis]:
    """Return bases of one variable, in the order in which they are tried."""

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


Product = tuple[tuple[int, int], ...]
"""Pairs of the number of a basis and that of one of its functions."""


@dataclass(frozen=True)
class Terms:
    """Products of functions.

    Attributes
    ----------
    bases : functions of variables, each variable in one of them at most
    products : the empty one, which is constant, first
    """

    bases: tuple[Basis, ...]
    products: tuple[Product, ...]

    @property
    def by_speed(self) -> bool:
        """Whether functions differ from speed to speed."""
        return any(basis.by_speed for basis in self.bases)

    def evaluate(self, values: Array, speed_rpm: float) -> Array:
        """Evaluate the products of designs, shape (design, product).

        Parameters
        ----------
        values : values of the designs, shape (design, variable), SI
        speed_rpm : speed of the closed forms among the functions, rpm
        """
        functions = [basis.evaluate(values, speed_rpm) for basis in self.bases]
        columns = np.ones((len(self.products), len(values)))
        row = {term: number for number, term in enumerate(self.products)}
        for number, term in enumerate(self.products[1:], 1):
            basis, function = term[-1]
            np.multiply(columns[row[term[:-1]]], functions[basis][:, function], columns[number])
        return columns.T


def products_of(bases: Sequence[Basis], meets: Iterable[tuple[int, int]]) -> tuple[Product, ...]:
    """Return all products of functions of bases that meet one another, by number of factors.

    Parameters
    ----------
    bases : functions of variables
    meets : pairs of numbers of bases whose effects do not just add, the lower first
    """
    pairs = set(meets)
    groups: list[tuple[int, ...]] = [()]
    longest: list[tuple[int, ...]] = [()]
    while longest:
        longest = [
            (*group, other)
            for group in longest
            for other in range(group[-1] + 1 if group else 0, len(bases))
            if all((number, other) in pairs for number in group)
        ]
        groups += longest
    return tuple(
        tuple(zip(group, choice, strict=True))
        for group in groups
        for choice in product(*(range(bases[number].size) for number in group))
    )
