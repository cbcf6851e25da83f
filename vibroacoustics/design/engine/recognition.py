"""Routes of the variables: linear algebra where probes show that this is exact."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np
from scipy.stats import qmc

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError, SolverError
from .expansion import RELATIVE, Expansion, deviation, fitted
from .samples import Samples, stacked
from .terms import Basis, Terms, bases_of, products_of

NODES: Final = 11
"""Designs along one variable: at most four are fitted, the others test."""
TESTS: Final = 16
"""Designs that test a fit, at random."""
KNOWN_TESTS: Final = 4
"""Designs that test a fit where the functions are known from another sample of the machine."""
KNOWN_RELATIVE: Final = 1e-8
"""Error there, of the largest size over the designs, that is rounding."""
LARGEST_FIT: Final = 1500
"""Products that are fitted at most."""
UNCHANGED: Final = 1e-12
"""Change of an array, of its size, that is rounding."""
NO_EFFECT: Final = "no effect"
_RANDOM: Final = 20261123


@dataclass(frozen=True)
class Route:
    """Route of a variable.

    Attributes
    ----------
    linear : whether designs are computed by linear algebra over its range
    reason : the functions by which it acts, or why each of its values takes a run
    """

    linear: bool
    reason: str


@dataclass(frozen=True)
class Explorer:
    """Explorer of designs along one variable after another.

    Attributes
    ----------
    samples : probes of designs, see `Samples`
    limits : limits of the variables, shape (variable, 2), SI
    speeds_rpm : speeds of the study, rpm
    wanted : names of the arrays that matter
    has_template : whether the functions are known from another sample, so that fewer designs do
    """

    samples: Samples
    limits: Array
    speeds_rpm: tuple[float, ...]
    wanted: frozenset[str]
    has_template: bool = False

    def basis_along(
        self, base: Array, group: tuple[int, ...], forms: Sequence[Basis]
    ) -> tuple[Basis | None, Route]:
        """Return the first basis that is exact along the variables of a group, and their route.

        Parameters
        ----------
        base : values of a design, shape (variable,)
        group : numbers of variables
        forms : closed forms of all of them; a single variable is tried in simple functions too
        """
        values = np.repeat(base[None], NODES if len(group) == 1 else 2 * NODES, axis=0)
        values[1:, group] = spread(self.limits[list(group)], len(values) - 1)
        try:
            arrays = self.arrays(values)
        except (ParameterError, SolverError) as error:
            return None, Route(False, str(error))
        parts = [part for of_speed in arrays for part in of_speed.values()]
        if all(
            deviation(part, np.broadcast_to(part[:1], part.shape)) <= UNCHANGED for part in parts
        ):
            return None, Route(True, NO_EFFECT)
        simple = bases_of(group[0], *self.limits[group[0]].tolist()) if len(group) == 1 else []
        for basis in (*forms, *simple):
            terms = Terms((basis,), products_of((basis,), ()))
            if self._error(self._fitted(terms, values, arrays), values, arrays) <= RELATIVE:
                return basis, Route(True, basis.name)
        return None, Route(False, "is linear in no known functions")

    def pairs(self, base: Array, bases: Sequence[Basis]) -> list[tuple[int, int]]:
        """Return the numbers of pairs of bases whose effects do not just add."""
        share = np.random.default_rng(_RANDOM).uniform(0.1, 0.9, base.size)
        other = self.limits[:, 0] + share * np.ptp(self.limits, axis=1)
        meeting = []
        for pair in combinations(range(len(bases)), 2):
            corners = np.repeat(base[None], 4, axis=0)
            for number, rows in zip(pair, ([1, 3], [2, 3]), strict=True):
                columns = list(bases[number].variables)
                corners[np.ix_(rows, columns)] = other[columns]
            if any(_do_not_add(part) for group in self.arrays(corners) for part in group.values()):
                meeting.append(pair)
        return meeting

    def expansions(self, base: Array, terms: Terms) -> list[Expansion]:
        """Compute expansions by speed, last that of the body, tested at random designs.

        Parameters
        ----------
        base : values of a design, shape (variable,); those of variables without a basis hold
        terms : products of the variables with a basis

        Raises
        ------
        ParameterError, SolverError
            A design cannot be built, or the expansions are not exact.
        """
        count = len(terms.products)
        if count > LARGEST_FIT:
            raise SolverError(f"{count} products of functions: more than {LARGEST_FIT}")
        columns = sorted(number for basis in terms.bases for number in basis.variables)
        tests = KNOWN_TESTS if self.has_template else TESTS
        values = np.repeat(base[None], fits(terms, self.has_template) + tests, axis=0)
        if columns:
            values[:, columns] = spread(self.limits[columns], len(values))
        arrays = self.arrays(values)
        fit = [{name: part[:-tests] for name, part in group.items()} for group in arrays]
        test = [{name: part[-tests:] for name, part in group.items()} for group in arrays]
        expansions = self._fitted(terms, values[:-tests], fit)
        error = self._error(expansions, values[-tests:], test)
        if error > (KNOWN_RELATIVE if self.has_template else RELATIVE):
            raise SolverError(f"linear in products of known functions to {error:.1g} only")
        return expansions

    def arrays(self, values: Array) -> list[dict[str, ComplexArray]]:
        """Return the wanted arrays of designs, by speed, last those of the body."""
        groups = stacked(self.samples.probes_of(values))
        return [
            {name: array for name, array in group.items() if name in self.wanted}
            for group in groups
        ]

    def _fitted(
        self, terms: Terms, values: Array, arrays: Sequence[dict[str, ComplexArray]]
    ) -> list[Expansion]:
        speeds = (*self.speeds_rpm, self.speeds_rpm[0])
        return [
            fitted(terms, speed, values, group) for speed, group in zip(speeds, arrays, strict=True)
        ]

    @staticmethod
    def _error(
        expansions: Sequence[Expansion], values: Array, arrays: Sequence[dict[str, ComplexArray]]
    ) -> float:
        """Return the largest deviation of any array."""
        errors = [
            deviation(part, np.broadcast_to(computed[name], part.shape))
            for computed, group in zip(
                (expansion.arrays_of(values) for expansion in expansions), arrays, strict=True
            )
            for name, part in group.items()
        ]
        return max(errors, default=0.0)


def fits(terms: Terms, has_template: bool = False) -> int:
    """Return the number of designs that a fit needs."""
    count = len(terms.products)
    return count + (0 if has_template else count // 2) + 4 if terms.bases else 1


def spread(limits: Array, count: int) -> Array:
    """Return designs that fill a box evenly, shape (count, variable), the same at every call.

    Parameters
    ----------
    limits : lowest and highest value, shape (variable, 2)
    count : number of designs
    """
    if not len(limits):
        return np.zeros((count, 0))
    if len(limits) == 1:
        share = 0.5 - 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / count)[:, None]
    else:
        share = qmc.LatinHypercube(len(limits), rng=_RANDOM).random(count)
    return np.asarray(limits[:, 0] + share * (limits[:, 1] - limits[:, 0]))


def _do_not_add(corners: ComplexArray) -> bool:
    """Whether the effect of two changes is not the sum of theirs, shape (4, ...)."""
    none, first, second, _ = corners
    expected = np.stack([none, first, second, first + second - none])
    return deviation(corners, expected) > RELATIVE
