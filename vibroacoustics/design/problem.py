"""Designs and what is wanted of them: one call from rows of numbers to objectives."""

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array
from ..base.vocabulary import REFERENCE_OPTION
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.design import Design, Objective, Statistic, Wanted
from ..study.study import Study
from .engine.engine import Engine
from .engine.needs import PAIRED, ResponsesByNeed
from .engine.recognition import Route
from .ensemble import ComparedMachine, compared_machines
from .figure import FIGURES, DesignFigure, Setting
from .space import Space
from .statistics import Splitting, by_speed, of_each, statistic_of, weighted_statistic
from .tolerances import Pieces
from .wanted import (
    CHANGE_OF_TOTAL,
    CONFIDENCE,
    MEDIAN,
    MOST_PIECES_KEEP,
    TOTALS,
    figure_of,
    more_is_better,
    needs_of,
)  # fmt: skip

MOST_ROWS: Final = 16_384
"""Designs times samples that are computed side by side."""


@dataclass(frozen=True)
class Judged:
    """Designs with what is wanted of them.

    Attributes
    ----------
    values : value of every objective and constraint in its unit, shape (design, wanted),
        objectives first; not a number where a design failed
    objectives : objectives with signs, less is always better, shape (design, objective)
    constraints : excess of each constraint in its unit, at most zero where a design meets it, shape
        (design, constraint)
    failed : reason by number of the design
    """

    values: Array
    objectives: Array
    constraints: Array
    failed: Mapping[int, str] = field(default_factory=dict)


class Compared(NamedTuple):
    """A machine without an option.

    Attributes
    ----------
    responses : responses of its pieces and pairs
    setting : function that gives the settings of a figure
    changes : reference values of changes, by figure; none of figures that are no change
    """

    responses: ResponsesByNeed
    setting: Callable[[Wanted], Setting]
    changes: list[Array | None]


class Problem:
    """Objectives and constraints of a study's table `design` as a function of designs.

    Parameters
    ----------
    study : study with the table `design`
    radiation : function that gives the transfer vectors; the package's where it is not given

    Raises
    ------
    ParameterError
        The table names what the study does not have.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml").replace({"design": {
    ...     "option": ["counterweight-half"],
    ...     "variables": {"options.counterweight-half.share_ratio": {"range": [0.0, 1.0]}},
    ...     "objectives": {"foot": {"figure": "foot_force_n", "order": 1}},
    ... }})
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> problem = va.Problem(study, va.given_radiation(vectors, frequency))
    >>> problem.evaluate(np.array([[0.0], [0.5]])).objectives.shape  # (design, objective), N
    (2, 1)
    """

    def __init__(self, study: Study, radiation: Radiation = transfer_vectors) -> None:
        self.study = study
        self.space = Space.of(study)
        self.design: Design = study.design  # type: ignore[assignment]
        self.pieces = Pieces.of(study, self.space)
        self.wanted: dict[str, Wanted] = {**self.design.objectives, **self.design.constraints}
        self.figures = [figure_of(study, self.design, name, w) for name, w in self.wanted.items()]
        each = zip(self.figures, self.wanted.items(), strict=True)
        needs = [needs_of(study, self.design, figure, *item) for figure, item in each]
        self.radiation = radiation
        self._references: dict[tuple[int, bytes], Compared] = {}
        self._needs = tuple(dict.fromkeys(need for some in needs for need in some))

    @property
    def names(self) -> list[str]:
        """Names of objectives and constraints, in the order of the values."""
        return list(self.wanted)

    @property
    def is_linear(self) -> bool:
        """Whether all goes by linear algebra, so that a design costs next to nothing."""
        return not self.run_columns

    @cached_property
    def run_columns(self) -> list[int]:
        """Numbers of the variables and values that scatter alone that take runs."""
        return Splitting.of(self._routes, 1).slow

    @cached_property
    def splitting(self) -> Splitting:
        """Pieces of designs that are computed together."""
        routes = self._routes[: len(self.space.variables)]
        return Splitting.of(routes, self.most_designs(self.samples()))

    @property
    def _routes(self) -> list[tuple[Route, ...]]:
        """Routes of each variable, and of each value that scatters alone, by option."""
        each = [self.engine.routes(name).values() for name in self.space.options]
        return list(zip(*each, strict=True))

    def most_designs(self, samples: Array) -> int:
        """Return the number of designs that are computed side by side.

        Parameters
        ----------
        samples : samples of the tolerances, shape (sample, scatter)
        """
        return max(MOST_ROWS // self.weight(samples).size, 1)

    @cached_property
    def machines(self) -> list[ComparedMachine]:
        """Samples of the study, the same for all designs, or the nominal machine alone."""
        return compared_machines(self.study, self.pieces, self._needs, self.radiation)

    @property
    def is_sampled(self) -> bool:
        """Whether designs are computed for samples of the machine."""
        return self.machines[0].machine.deviation is not None

    @property
    def engine(self) -> Engine:
        """The engine of the first machine; variables act alike in those of the others."""
        return self.machines[0].engine

    def samples(self, count: int | None = None, number: int = 0) -> Array:
        """Samples of the tolerances, shape (sample, scatter); the same at every call.

        Parameters
        ----------
        count : number of samples; that of the study where it is not given
        number : number of the set; sets of other numbers are independent
        """
        return self.pieces.samples(count or self.design.tolerance_samples, number)

    def samples_of_run(self, run: int) -> Array:
        """Samples of the tolerances for a run of an active search, shape (sample, scatter).

        Parameters
        ----------
        run : its number; -1 is the run without scatter
        """
        if run < 0:
            return self.pieces.as_meant
        return self.pieces.of_run(self.design.search.seed, run, len(self.machines))

    def evaluate(self, designs: Array, samples: Array | None = None) -> Judged:
        """Evaluate the objectives and constraints of designs.

        Parameters
        ----------
        designs : shape (design, variable), SI; see `Space`
        samples : samples of the tolerances, shape (sample, scatter); default: those of `samples()`
        """
        samples = self.samples() if samples is None else samples
        size = self.most_designs(samples)
        parts = [
            self._judged(designs[first : first + size], samples, first)
            for first in range(0, len(designs), size)
        ]
        nothing = np.zeros((0, len(self.wanted)))
        values = np.concatenate([part[0] for part in parts]) if parts else nothing
        return self.judged(values, {row: why for _, some in parts for row, why in some.items()})

    def judged(self, values: Array, failed: Mapping[int, str]) -> Judged:
        """Designs whose values are known, with signs and limits.

        Parameters
        ----------
        values : shape (design, wanted)
        failed : reason by number of the design
        """
        return Judged(values, *self._signed(values), failed)

    def by_sample(self, designs: Array, samples: Array) -> Array:
        """Every wanted value by machine and piece, shape (design, sample, wanted), in its unit.

        Parameters
        ----------
        designs : shape (design, variable), SI
        samples : samples of the tolerances, shape (sample, scatter)
        """
        return self._of_pieces(designs, samples)[0]

    def weight(self, samples: Array) -> Array:
        """Weights of the samples of `by_sample`, of sum one, shape (sample,).

        Parameters
        ----------
        samples : samples of the tolerances, shape (sample, scatter)
        """
        each = [
            np.tile(machine.machine.weight / len(shares), len(shares))
            for machine, shares in self._shared_out(samples)
        ]
        weight = np.concatenate(each)
        return np.asarray(weight / weight.sum())

    def without_option(self) -> Array:
        """Every wanted value of the machine without an option, shape (wanted,)."""
        rows = []
        for compared in self.machines:
            responses, setting, reference = self._compared(compared, self.pieces.present[None])
            columns = [
                of_each(figure, responses, setting(wanted), more_is_better(wanted), before)
                for (figure, wanted), before in zip(self._each, reference, strict=True)
            ]
            rows.append(np.stack(columns, axis=1))
        weight = self.weight(self.pieces.as_meant)
        return np.asarray(self.over_samples(np.concatenate(rows)[None], weight)[0])

    def total_changes(self) -> list["Problem"]:
        """Return the same designs with changes of the total level instead of each total.

        Those of the objectives that are totals, over their speeds and microphones: the median of
        all samples and pieces, and what a share `CONFIDENCE` of them stays below.
        """
        _ = self.machines  # shared
        return [
            self._instead(objective)
            for objective in self.design.objectives.values()
            if objective.figure in TOTALS
        ]

    def _instead(self, objective: Objective) -> "Problem":
        """Make changes of a total the only objectives of the designs."""
        other = copy(self)
        other.wanted = {
            name: objective.model_copy(
                update={"figure": CHANGE_OF_TOTAL, "goal": "least", "samples": share}
            )
            for name, share in (("median", MEDIAN), ("confident", CONFIDENCE))
        }
        other.figures = [FIGURES[CHANGE_OF_TOTAL]() for _ in other.wanted]
        other.design = self.design.model_copy(
            update={"objectives": other.wanted, "constraints": {}}
        )
        other._references = {}
        return other

    def in_units(self, objectives: Array, constraints: Array) -> Array:
        """Wanted values in their units, of signed objectives and constraints; see `Judged`."""
        sign, side, limit = self.signs
        return np.concatenate([objectives * sign, side * constraints + limit], axis=1)

    @property
    def _each(self) -> list[tuple[DesignFigure, Wanted]]:
        """Figures with what is wanted of them."""
        return list(zip(self.figures, self.wanted.values(), strict=True))

    def _judged(self, designs: Array, samples: Array, first: int) -> tuple[Array, dict[int, str]]:
        by_sample, failed = self._of_pieces(designs, samples)
        values = self.over_samples(by_sample, self.weight(samples))
        values[list(failed)] = np.nan
        return values, {first + row: why for row, why in failed.items()}

    def over_samples(self, by_sample: Array, weight: Array) -> Array:
        """Statistics of samples, shape (design, wanted); see `by_sample` and `weight`."""
        columns = []
        for column, wanted in enumerate(self.wanted.values()):
            values, statistic = by_sample[:, :, column], self.statistic(wanted)
            if self.is_sampled:
                columns.append(
                    weighted_statistic(values, weight, statistic, more_is_better(wanted))
                )
            else:
                columns.append(statistic_of(values, 1, statistic, more_is_better(wanted)))
        return np.stack(columns, axis=1)

    def statistic(self, wanted: Wanted) -> Statistic:
        """Return the statistic over samples: without one the median, of nominal pieces 90 %.

        An active search has the mean of nominal pieces, each of which is a run.
        """
        nominal: Statistic = "mean" if self.design.search.method == "active" else MOST_PIECES_KEEP
        default = MEDIAN if self.is_sampled else nominal
        return default if wanted.samples is None else wanted.samples

    def _shared_out(self, samples: Array) -> list[tuple[ComparedMachine, Array]]:
        """Machines, each with its own of the pieces, the same at every call."""
        count, pieces = len(self.machines), len(samples)
        return [(each, samples[n % pieces :: count]) for n, each in enumerate(self.machines)]

    def _of_pieces(self, designs: Array, samples: Array) -> tuple[Array, dict[int, str]]:
        """Wanted values, shape (design, sample, wanted), and why designs failed."""
        parts: list[Array] = []
        failed: dict[int, str] = {}
        for machine, shares in self._shared_out(samples):
            values, reasons = self._of_machine(machine, designs, shares)
            parts.append(values)
            failed |= reasons
        return np.concatenate(parts, axis=1), failed

    def _of_machine(
        self, compared: ComparedMachine, designs: Array, shares: Array
    ) -> tuple[Array, dict[int, str]]:
        """Wanted values of the pieces of a machine, shape (design, piece and pair, wanted)."""
        pieces = self.pieces.made(designs, shares).reshape(len(designs) * len(shares), -1)
        outcome, pairs = compared.engine.outcome(pieces), compared.machine.weight.size
        failed = {row // len(shares): why for row, why in outcome.failed.items()}
        if not outcome.results:
            shape = (len(designs), len(shares) * pairs, len(self.wanted))
            return np.full(shape, np.nan), failed
        responses = _by_row(outcome.results, pairs)
        reference: list[Array | None] = [None] * len(self.figures)
        if any(figure.is_change for figure in self.figures):
            _, _, reference = self._reference(compared, shares)

        def unmodelled() -> Array:
            of_options = map(compared.machine.unmodelled, self.space.options)
            each = np.array([noise.square for noise in of_options])
            chooses = len(self.space.options) > 1
            return _rows(each[np.rint(pieces[:, 0] * chooses).astype(int)])

        columns = []
        for (figure, wanted), before in zip(self._each, reference, strict=True):
            setting = Setting(wanted, self._speeds, unmodelled)
            change = None if before is None else np.concatenate([before] * len(designs))
            columns.append(of_each(figure, responses, setting, more_is_better(wanted), change))
        values = np.stack(columns, axis=1).reshape(len(designs), len(shares) * pairs, -1)
        return values, failed

    def _reference(self, compared: ComparedMachine, shares: Array) -> Compared:
        """Return the responses of pieces of a machine without an option, kept."""
        key = id(compared), shares.tobytes()
        if key not in self._references:
            nothing = np.zeros((1, len(self.space.variables)))
            pieces = self.pieces.made(nothing, shares)[0, :, len(self.space.variables) :]
            self._references[key] = self._compared(compared, pieces)
        return self._references[key]

    def _compared(self, compared: ComparedMachine, pieces: Array) -> Compared:
        """Return the responses of a machine without an option, and the reference of changes.

        Parameters
        ----------
        compared : the machine
        pieces : values that scatter but no design chooses, shape (piece, value), SI
        """
        responses = _by_row(
            compared.reference.outcome(pieces).results, compared.machine.weight.size
        )

        def setting(wanted: Wanted) -> Setting:
            def unmodelled() -> Array:
                unmodelled_square = compared.machine.unmodelled(REFERENCE_OPTION).square
                return np.tile(unmodelled_square, (len(pieces), 1, 1))

            return Setting(wanted, self._speeds, unmodelled)

        changes = [
            by_speed(figure, responses, setting(wanted)) if figure.is_change else None
            for figure, wanted in self._each
        ]
        return Compared(responses, setting, changes)

    @property
    def _speeds(self) -> Array:
        return np.array(self.study.operation.speed_rpm)

    def _signed(self, values: Array) -> tuple[Array, Array]:
        """Objectives of which less is better, constraints that are met at zero and below."""
        sign, side, limit = self.signs
        return values[:, : sign.size] * sign, side * (values[:, sign.size :] - limit)

    @property
    def signs(self) -> tuple[Array, Array, Array]:
        """Signs of the objectives; signs of the constraints, and their limits."""
        sign = [-1.0 if w.goal == "greatest" else 1.0 for w in self.design.objectives.values()]
        limits = [
            (1.0, w.at_most) if w.at_most is not None else (-1.0, w.at_least or 0.0)
            for w in self.design.constraints.values()
        ]
        side, limit = np.array(limits, dtype=float).reshape(-1, 2).T
        return np.array(sign), side, limit


def _by_row(responses: ResponsesByNeed, pairs: int) -> ResponsesByNeed:
    """Return the responses with a row for each pair of each design.

    Parameters
    ----------
    responses : those in `PAIRED` of shape (design, pair, ...), others of shape (design, ...)
    pairs : number of pairs of a discrepancy and an unmodelled level
    """
    return {
        need: _rows(values) if need.what in PAIRED else np.repeat(values, pairs, axis=0)
        for need, values in responses.items()
    }


def _rows(values: Array) -> Array:
    """The first two axes as one."""
    return values.reshape(-1, *values.shape[2:])
