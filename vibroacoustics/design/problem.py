"""Designs and what is wanted of them: one call from rows of numbers to objectives."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.criterion import CRITERIA
from ..study.design import Constraint, Design, Objective, Wanted
from ..study.study import Study
from .engine.engine import Engine
from .engine.option_engine import Outcome
from .engine.seen import Need, Seen
from .figure import FIGURES, DesignFigure, OfCriterion, Setting
from .reference import reference_of, remainder_of
from .space import Space
from .statistics import of_each, over
from .tolerances import Pieces

LINEAR_PIECE: Final = 256
RUN_PIECE: Final = 4
MOST_PIECES: Final = 100_000
"""That are judged side by side."""


@dataclass(frozen=True)
class Judged:
    """Designs with what is wanted of them.

    Attributes
    ----------
    values : of every objective and constraint in its unit, shape (design, wanted), objectives
        first; not a number where a design failed
    objectives : the same, less is always better, shape (design, objective)
    constraints : at most zero where a design keeps to them, in their units, (design, constraint)
    failed : reason by number of the design
    """

    values: Array
    objectives: Array
    constraints: Array
    failed: Mapping[int, str] = field(default_factory=dict)


class Problem:
    """What a study's table `design` asks, as a function of designs.

    Parameters
    ----------
    study : with the table
    radiation : gives the transfer vectors; the package's where it is not given

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
        self.figures = [_figure(study, self.design, name, w) for name, w in self.wanted.items()]
        each = zip(self.figures, self.wanted.items(), strict=True)
        needs = [_needs(study, self.design, figure, *item) for figure, item in each]
        self._radiation = radiation
        every = tuple(dict.fromkeys(need for some in needs for need in some))
        self.engine = Engine(self.pieces.wide, self.pieces.limits, every, radiation)

    @property
    def names(self) -> list[str]:
        """Of objectives and constraints, in the order of the values."""
        return list(self.wanted)

    @cached_property
    def is_linear(self) -> bool:
        """Whether all goes by linear algebra, so that a design costs next to nothing."""
        routes = [self.engine.routes(option).values() for option in self.space.options]
        return all(route.linear for each in routes for route in each)

    @property
    def piece(self) -> int:
        """Designs that are evaluated together, here and by workers alike."""
        return LINEAR_PIECE if self.is_linear else RUN_PIECE

    @cached_property
    def reference(self) -> Seen:
        """What is seen of the study as given without an option."""
        return reference_of(self.study, self.engine.needs, self.engine.ways)

    @cached_property
    def remainder(self) -> Array:
        """What the model leaves of the machine's level, (option, speed, receiver), Pa²."""
        return remainder_of(self.study, self.space.options, self._radiation)

    def samples(self, count: int | None = None, number: int = 0) -> Array:
        """Samples of the tolerances, shape (sample, scatter); the same at every call.

        Parameters
        ----------
        count : of samples; those of the study where it is not given
        number : of the set; sets of other numbers are independent
        """
        return self.pieces.samples(count or self.design.tolerance_samples, number)

    def evaluate(self, designs: Array, samples: Array | None = None) -> Judged:
        """What is wanted of designs.

        Parameters
        ----------
        designs : shape (design, variable), SI; see `Space`
        samples : of the tolerances, shape (sample, scatter); default: those of `samples()`
        """
        samples = self.samples() if samples is None else samples
        size = max(MOST_PIECES // len(samples), 1)
        parts = [
            self._judged(designs[first : first + size], samples, first)
            for first in range(0, len(designs), size)
        ]
        values = np.concatenate([part[0] for part in parts]) if parts else self._no_values()
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
        """Every wanted value of every piece, shape (design, sample, wanted), in its unit.

        Parameters
        ----------
        designs : shape (design, variable), SI
        samples : of the tolerances, shape (sample, scatter)
        """
        return self._of_pieces(designs, samples)[0]

    def without_option(self) -> Array:
        """Every wanted value of the study as given without an option, shape (wanted,)."""
        speeds = np.array(self.study.operation.speed_rpm)

        def remainder() -> Array:
            return remainder_of(self.study, (REFERENCE_OPTION,), self._radiation)

        def value(figure: DesignFigure, wanted: Wanted) -> float:
            setting = Setting(wanted, speeds, lambda: self.reference, remainder)
            return float(of_each(figure, self.reference, setting, more_is_better(wanted))[0])

        each = zip(self.figures, self.wanted.values(), strict=True)
        return np.array([value(figure, wanted) for figure, wanted in each])

    def in_units(self, objectives: Array, constraints: Array) -> Array:
        """Wanted values in their units, of signed objectives and constraints; see `Judged`."""
        sign, side, limit = self._signs
        return np.concatenate([objectives * sign, side * constraints + limit], axis=1)

    def _no_values(self) -> Array:
        return np.zeros((0, len(self.wanted)))

    def _judged(self, designs: Array, samples: Array, first: int) -> tuple[Array, dict[int, str]]:
        by_sample, outcome = self._of_pieces(designs, samples)
        values = np.stack(
            [
                over(by_sample[:, :, column], 1, wanted.samples, more_is_better(wanted))
                for column, wanted in enumerate(self.wanted.values())
            ],
            axis=1,
        )
        failed = {first + row // len(samples): why for row, why in outcome.failed.items()}
        values[[row - first for row in failed]] = np.nan
        return values, failed

    def _of_pieces(self, designs: Array, samples: Array) -> tuple[Array, Outcome]:
        pieces = self.pieces.made(designs, samples).reshape(len(designs) * len(samples), -1)
        outcome = self.engine.outcome(pieces)
        columns = [
            of_each(figure, outcome.seen, self._setting(wanted, pieces), more_is_better(wanted))
            for figure, wanted in zip(self.figures, self.wanted.values(), strict=True)
        ]
        return np.stack(columns, axis=1).reshape(len(designs), len(samples), -1), outcome

    def _setting(self, wanted: Wanted, pieces: Array) -> Setting:
        def remainder() -> Array:
            choice = np.rint(pieces[:, 0]).astype(int) if len(self.space.options) > 1 else [0]
            return np.asarray(self.remainder[choice])

        speeds = np.array(self.study.operation.speed_rpm)
        return Setting(wanted, speeds, lambda: self.reference, remainder)

    def _signed(self, values: Array) -> tuple[Array, Array]:
        """Objectives of which less is better, constraints that are met at zero and below."""
        sign, side, limit = self._signs
        return values[:, : sign.size] * sign, side * (values[:, sign.size :] - limit)

    @property
    def _signs(self) -> tuple[Array, Array, Array]:
        """Of the objectives; of the constraints, and their limits."""
        sign = [-1.0 if w.goal == "greatest" else 1.0 for w in self.design.objectives.values()]
        limits = [
            (1.0, w.at_most) if w.at_most is not None else (-1.0, w.at_least or 0.0)
            for w in self.design.constraints.values()
        ]
        side, limit = np.array(limits, dtype=float).reshape(-1, 2).T
        return np.array(sign), side, limit


def more_is_better(wanted: Wanted) -> bool:
    """Whether the smallest value is the worst."""
    if isinstance(wanted, Objective):
        return wanted.goal == "greatest"
    return isinstance(wanted, Constraint) and wanted.at_least is not None


def _where(study: Study, design: Design, name: str) -> str:
    table = "objectives" if name in design.objectives else "constraints"
    return f"{study.source_file}: design.{table}.{name}"


def _figure(study: Study, design: Design, name: str, wanted: Wanted) -> DesignFigure:
    if name in design.objectives and name in design.constraints:
        raise ParameterError(
            f"{study.source_file}: design.constraints.{name}: is an objective's name too"
        )
    if wanted.figure in FIGURES:
        return FIGURES[wanted.figure]()
    if wanted.figure in CRITERIA:
        return OfCriterion(wanted.figure)
    where = f"{_where(study, design, name)}.figure = {wanted.figure}"
    raise ParameterError(f"{where}: {FIGURES.unknown(wanted.figure, CRITERIA)}")


def _needs(
    study: Study, design: Design, figure: DesignFigure, name: str, wanted: Wanted
) -> tuple[Need, ...]:
    try:
        return figure.needs(wanted)
    except ParameterError as error:
        raise ParameterError(f"{_where(study, design, name)}.{error}") from None
