"""Products of functions of the variables."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...base.arrays import Array
from .bases import Basis

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

    def at(self, values: Array, speed_rpm: float) -> Array:
        """Products of designs, shape (design, product).

        Parameters
        ----------
        values : shape (design, variable)
        speed_rpm : of the closed forms among the functions
        """
        functions = [basis.at(values, speed_rpm) for basis in self.bases]
        columns = np.ones((len(self.products), len(values)))
        row = {term: number for number, term in enumerate(self.products)}
        for number, term in enumerate(self.products[1:], 1):
            basis, function = term[-1]
            np.multiply(columns[row[term[:-1]]], functions[basis][:, function], columns[number])
        return columns.T


def products_of(bases: Sequence[Basis], meets: Iterable[tuple[int, int]]) -> tuple[Product, ...]:
    """All products of functions of bases that meet one another, by number of factors.

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
            if all((one, other) in pairs for one in group)
        ]
        groups += longest
    return tuple(
        tuple(zip(group, choice, strict=True))
        for group in groups
        for choice in product(*(range(bases[number].size) for number in group))
    )
