"""All designs with one option: by linear algebra, or run by run."""

from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError, SolverError
from .contraction import Contraction, Layouts
from .deviating import Gains
from .expansion import Expansion
from .hearing import Hearing
from .joined_designs import Joined, LinearDesigns, joined_designs
from .needs import Need, ResponsesByNeed
from .on_mounts import Lines, lines_of
from .probe import Probe
from .recognition import NO_EFFECT, TESTS, Explorer, Route, fits, spread
from .sound_path import PathOfDesign
from .terms import Basis, Terms, products_of

ARRAYS: Final = frozenset({
    "wrench", "load", "shell", "random", "factor",
    "mass", "stiffness", "foot", "added", "foot_added",
})  # fmt: skip
"""Arrays on which any figure may depend; reported figures matter where they are requested."""
FILLING: Final = 64
"""Designs that show which bands vary over the space."""
MOST_JOINED: Final = 2048
"""Designs whose loads and paths are joined at a time; 0.6 GB with loads of 0.15 MB, twice held."""
MOST_GROUPS: Final = 256
"""Sets of values that take runs, of which linear designs are kept."""
ON_PATH: Final = "changes the path from the loads to the microphones"
Score = Callable[[Array], ResponsesByNeed]
"""Function of the values of a design, shape (variable,): requested criteria, shape (1,)."""


@dataclass
class Outcome:
    """Responses of designs, and why some have failed.

    Attributes
    ----------
    results : responses by need; not a number where a design failed
    failed : reason of the failure by number of the design
    """

    results: dict[Need, Array] = field(default_factory=dict)
    failed: dict[int, str] = field(default_factory=dict)

    def take(self, rows: IndexArray, part: ResponsesByNeed, count: int) -> None:
        """Add the responses of some of so many designs."""
        for need, values in part.items():
            if need not in self.results:
                self.results[need] = np.full((count, *values.shape[1:]), np.nan)
            self.results[need][rows] = values

    def take_or_fail(self, rows: IndexArray, part: ResponsesByNeed | Exception, count: int) -> None:
        """Add the responses of some of so many designs, or why they failed."""
        if isinstance(part, Exception):
            self.failed |= dict.fromkeys(rows.tolist(), str(part))
        else:
            self.take(rows, part, count)

    def hearing(self, needs: Sequence[Need], count: int) -> Hearing:
        """Return the collector of loudness and audibility of so many designs."""
        return Hearing(needs, lambda rows, part: self.take_or_fail(rows, part, count))


@dataclass
class OptionEngine:
    """Designs with one option.

    Attributes
    ----------
    explorer : probes of its designs
    contraction : loads, paths and bodies of its designs
    needs : requested responses
    linear : numbers of the variables that may be linear
    idle : numbers of the variables without effect on the option
    forms : closed forms of the option
    score : computes the criteria of a design
    gains : gains of the sample by speed; none for the nominal machine
    unmodelled : noise by speed, shape (pair, receiver, band), Pa²; none where not requested
    template : engine of another sample, whose products and routes hold here too
    """

    explorer: Explorer
    contraction: Contraction
    needs: tuple[Need, ...]
    linear: tuple[int, ...]
    idle: tuple[int, ...]
    forms: tuple[Basis, ...]
    score: Score
    gains: tuple[Gains | None, ...]
    unmodelled: tuple[Array | None, ...]
    template: "OptionEngine | None" = None
    _expansions: dict[Hashable, tuple[Probe, list[Expansion]] | None] = field(
        default_factory=dict, repr=False
    )
    _groups: dict[bytes, LinearDesigns | None] = field(default_factory=dict, repr=False)

    @cached_property
    def recognised(self) -> tuple[Terms, tuple[Route, ...]]:
        """Products in which loads and matrices are linear, and the route of each variable."""
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
        on_path = self._read_by_path(base) if groups else []
        for group in groups:
            if not set(group).isdisjoint(on_path):
                for number in group:
                    routes[number] = Route(False, ON_PATH)
                continue
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

    def _read_by_path(self, design: Array) -> list[int]:
        """Numbers of the variables that the path of a design depends on."""
        with suppress(ParameterError, SolverError):
            paths = self.contraction.paths(self.contraction.loads(design).layout)
            paths(design)
            return paths.reads
        return []

    def outcome(self, values: Array) -> Outcome:
        """Compute the responses of designs, shape (design, variable)."""
        terms, routes = self.recognised
        of_runs = [number for number, route in enumerate(routes) if not route.linear]
        result, alone = Outcome(), []
        hearing = result.hearing(self.needs, len(values))
        _, group = np.unique(values[:, of_runs], axis=0, return_inverse=True)
        order = np.argsort(group.ravel(), kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(group.ravel()[order])) + 1):
            linear = self._linear(terms, values[rows], of_runs)
            if linear is None:
                alone.append(rows)
                continue
            for part, figures, spectra in linear.results(values[rows]):
                result.take(rows[part], figures, len(values))
                if spectra:
                    hearing.add(rows[part], spectra)
        hearing.finish()
        if alone:
            self._each(values, np.concatenate(alone), result)
        self._explain(values, result)
        return result

    def _linear(self, terms: Terms, values: Array, of_runs: Sequence[int]) -> LinearDesigns | None:
        """Designs of one set of values that take a run; none where runs of each are less."""
        if of_runs and (not terms.bases or len(values) <= fits(terms) + TESTS):
            return None  # whatever was fitted before: the same designs give the same bits
        key = values[0, of_runs].tobytes()
        if key not in self._groups:
            if len(self._groups) >= MOST_GROUPS:
                self._groups.clear()  # joined again in milliseconds
            self._groups[key] = self._prepared(terms, values[0], of_runs)
        return self._groups[key]

    def _prepared(
        self, terms: Terms, design: Array, of_runs: Sequence[int]
    ) -> LinearDesigns | None:
        base = self._base()
        base[list(of_runs)] = design[list(of_runs)]
        columns = sorted(number for basis in terms.bases for number in basis.variables)
        fitted = self._fitted(terms, base)
        if fitted is None:
            return None
        probe, expansions = fitted
        paths = self.contraction.paths(probe.layout)
        try:
            lines = self._lines(probe.layout, paths(base))
        except (ParameterError, SolverError):
            return None
        if not set(columns).isdisjoint(paths.reads):
            return None
        designs = np.repeat(base[None], FILLING, axis=0)
        designs[:, columns] = spread(self.explorer.limits[columns], FILLING)
        return LinearDesigns.of(self.needs, lines, expansions, designs)

    def _fitted(self, terms: Terms, base: Array) -> tuple[Probe, list[Expansion]] | None:
        """Loads and bodies as sums of products; none where they are not exact.

        Designs that differ in their paths alone share them.
        """
        try:
            probe = self.contraction.probe(base)
        except (ParameterError, SolverError):
            return None
        reads = {*self.contraction.loads.reads, *self.contraction.stands(probe.layout).reads}
        key = probe.layout, tuple(sorted(reads)), base[sorted(reads)].tobytes()
        if key not in self._expansions:
            if len(self._expansions) >= MOST_GROUPS:
                self._expansions.clear()
            try:
                expansions = self.explorer.expansions(base, terms)
                self._expansions[key] = probe, expansions
            except (ParameterError, SolverError):
                self._expansions[key] = None
            self.explorer.samples.forget()
        return self._expansions[key]

    def _lines(self, layout: Layouts, path: PathOfDesign) -> tuple[Lines, ...]:
        beside = list(zip(self.gains, self.unmodelled, strict=True))
        return lines_of(self.explorer.speeds_rpm, layout, path.responses(layout), beside)

    def _each(self, values: Array, rows: IndexArray, result: Outcome) -> None:
        """Take in designs by products of their loads and paths, each of which is computed once."""
        different, same = np.unique(values[rows], axis=0, return_inverse=True)
        outcome = Outcome()
        failed, hearing = outcome.failed, outcome.hearing(self.needs, len(different))
        for some, part, spectra in self._joined(different):
            outcome.take_or_fail(some, part, len(different))
            if spectra:
                hearing.add(some, spectra)
        hearing.finish()
        if any(need.what == "criterion" for need in self.needs):
            self._score(different, outcome, failed)
        of_row = same.ravel()
        if outcome.results:
            every = {need: array[of_row] for need, array in outcome.results.items()}
            result.take(rows, every, len(values))
        each = zip(rows.tolist(), of_row.tolist(), strict=True)
        result.failed |= {row: failed[number] for row, number in each if number in failed}

    def _joined(self, designs: Array) -> Joined:
        """Join loads and paths of some designs at a time: their arrays are all in memory."""
        for first in range(0, len(designs), MOST_JOINED):
            block = designs[first : first + MOST_JOINED]
            joined = joined_designs(self.contraction, block, self._lines, self.needs)
            yield from ((first + some, part, spectra) for some, part, spectra in joined)

    def _score(self, designs: Array, outcome: Outcome, failed: dict[int, str]) -> None:
        """Take in the criteria of designs that have not failed."""
        for number, design in enumerate(designs):
            if number in failed:
                continue
            try:
                outcome.take(np.array([number]), self.score(design), len(designs))
            except (ParameterError, SolverError) as error:
                failed[number] = str(error)

    def _explain(self, values: Array, result: Outcome) -> None:
        """Reasons of designs that linear algebra has no values of: those of their runs."""
        bad = np.zeros(len(values), dtype=bool)
        for need, array in result.results.items():
            if need.what != "figure":
                bad |= ~np.isfinite(array).all(axis=tuple(range(1, array.ndim)))
        bad[list(result.failed)] = False
        for row in np.flatnonzero(bad):
            self._each(values, np.array([row]), result)
