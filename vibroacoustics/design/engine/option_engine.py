"""All designs with one option: by linear algebra, or run by run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError, SolverError
from .deviating import Gains
from .linear_designs import LinearDesigns
from .recognition import NO_EFFECT, TESTS, Explorer, Route, fits, spread
from .seen import Need, Seen
from .sound_way import Ways
from .terms import Basis, Terms, products_of

ARRAYS: Final = frozenset({
    "wrench", "load", "other", "noise", "factor",
    "mass", "stiffness", "foot", "added", "foot_added",
})  # fmt: skip
"""That every figure may come of; reported figures matter where they are asked for."""
FILLING: Final = 64
"""Designs that show which bands vary over the space."""
Run = Callable[[Array], Seen]
"""Of the values of a design, shape (variable,), to what is seen of it, shape (1, ...)."""


@dataclass
class Outcome:
    """What is seen of designs, and why some have failed.

    Attributes
    ----------
    seen : by need; not a number where a design failed
    failed : reason by number of the design
    """

    seen: dict[Need, Array] = field(default_factory=dict)
    failed: dict[int, str] = field(default_factory=dict)

    def take(self, rows: IndexArray, part: Seen, count: int) -> None:
        """Take in what is seen of some of so many designs."""
        for need, values in part.items():
            if need not in self.seen:
                self.seen[need] = np.full((count, *values.shape[1:]), np.nan)
            self.seen[need][rows] = values


@dataclass
class OptionEngine:
    """Designs with one option.

    Attributes
    ----------
    explorer : probes of its designs
    ways : ways to the microphones
    needs : what is asked
    linear : numbers of the variables that may be linear
    idle : of those that say nothing of the option
    forms : closed forms of the option
    run : computes one design
    gains : of the sample by speed; none of the nominal machine
    unmodelled : noise by speed, shape (pair, receiver, band), Pa²; none where not asked for
    template : products and routes that designs of another sample were found to have
    """

    explorer: Explorer
    ways: Ways
    needs: tuple[Need, ...]
    linear: tuple[int, ...]
    idle: tuple[int, ...]
    forms: tuple[Basis, ...]
    run: Run
    gains: tuple[Gains | None, ...]
    unmodelled: tuple[Array | None, ...]
    template: "OptionEngine | None" = None
    _groups: dict[bytes, LinearDesigns | None] = field(default_factory=dict, repr=False)

    @cached_property
    def recognised(self) -> tuple[Terms, tuple[Route, ...]]:
        """Products in which loads and matrices are linear, and which way each variable goes."""
        if self.template is not None:
            return self.template.recognised
        reason = "takes words, a criterion is asked for, or the search is active"
        routes = [Route(False, reason)] * len(self.explorer.limits)
        for number in self.idle:
            routes[number] = Route(True, NO_EFFECT)
        if not (self.linear or self.forms):
            return Terms((), ((),)), tuple(routes)
        base, bases = self._base(), []
        of_forms = {number for form in self.forms for number in form.variables}
        groups = dict.fromkeys(form.variables for form in self.forms)
        groups |= dict.fromkeys((n,) for n in self.linear if n not in of_forms)
        for group in groups:
            forms = [form for form in self.forms if form.variables == group]
            basis, route = self.explorer.basis_along(base, group, forms)
            for number in group:
                routes[number] = route
            bases += [] if basis is None else [basis]
        try:
            terms = Terms(tuple(bases), products_of(bases, self.explorer.pairs(base, bases)))
            self.explorer.expansions(base, terms)
        except (ParameterError, SolverError) as error:
            for basis in bases:
                for number in basis.variables:
                    routes[number] = Route(False, str(error))
            return Terms((), ((),)), tuple(routes)
        return terms, tuple(routes)

    def _base(self) -> Array:
        """A design with nothing special about it; words and whole numbers are their first."""
        limits = self.explorer.limits
        share = 0.3 + 0.4 * np.modf(0.618034 * np.arange(1, len(limits) + 1))[0]
        movable = np.isin(np.arange(len(limits)), self.linear)
        return np.asarray(
            np.where(movable, limits[:, 0] + share * np.ptp(limits, axis=1), limits[:, 0])
        )

    def outcome(self, values: Array) -> Outcome:
        """What is seen of designs, shape (design, variable)."""
        terms, routes = self.recognised
        of_runs = [number for number, route in enumerate(routes) if not route.linear]
        result = Outcome()
        _, group = np.unique(values[:, of_runs], axis=0, return_inverse=True)
        order = np.argsort(group.ravel(), kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(group.ravel()[order])) + 1):
            linear = self._linear(terms, values[rows], of_runs)
            if linear is None:
                self._run_each(values, rows, result)
                continue
            for part, seen in linear.seen(values[rows]):
                result.take(rows[part], seen, len(values))
        self._explain(values, result)
        return result

    def _linear(self, terms: Terms, values: Array, of_runs: Sequence[int]) -> LinearDesigns | None:
        """Designs of one set of values that take a run; none where runs of each are less."""
        if of_runs and (not terms.bases or len(values) <= fits(terms) + TESTS):
            return None  # whatever was fitted before: the same designs give the same bits
        key = values[0, of_runs].tobytes()
        if key not in self._groups:
            self._groups[key] = self._prepared(terms, values[0], of_runs)
        return self._groups[key]

    def _prepared(
        self, terms: Terms, design: Array, of_runs: Sequence[int]
    ) -> LinearDesigns | None:
        base = self._base()
        base[list(of_runs)] = design[list(of_runs)]
        try:
            expansions = self.explorer.expansions(base, terms)
            (probe,) = self.explorer.samples.at(base[None])
        except (ParameterError, SolverError):
            return None
        columns = sorted(number for basis in terms.bases for number in basis.variables)
        designs = np.repeat(base[None], FILLING, axis=0)
        designs[:, columns] = spread(self.explorer.limits[columns], FILLING)
        self.explorer.samples.forget()
        return LinearDesigns.of(
            self.needs,
            probe,
            self.explorer.speeds_rpm,
            expansions,
            self.ways.of(probe.way),
            self.gains,
            self.unmodelled,
            designs,
        )

    def _run_each(self, values: Array, rows: IndexArray, result: Outcome) -> None:
        different, first = np.unique(values[rows], axis=0, return_inverse=True)
        for number, design in enumerate(different):
            same = rows[first.ravel() == number]
            try:
                result.take(same, self.run(design), len(values))
            except (ParameterError, SolverError) as error:
                result.failed |= dict.fromkeys(same.tolist(), str(error))

    def _explain(self, values: Array, result: Outcome) -> None:
        """Reasons of designs that linear algebra has no values of: those of their runs."""
        bad = np.zeros(len(values), dtype=bool)
        for need, seen in result.seen.items():
            if need.what != "figure":
                bad |= ~np.isfinite(seen).all(axis=tuple(range(1, seen.ndim)))
        bad[list(result.failed)] = False
        self._run_each(values, np.flatnonzero(bad), result)
