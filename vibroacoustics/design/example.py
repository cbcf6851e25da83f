"""Values of a template by what they do to the level: each is moved, and the levels follow anew."""

import json
import time
import warnings
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import ceil, floor
from typing import Any, Final, NamedTuple

import xarray as xr

from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError, SolverError
from ..base.fault import FaultError
from ..base.processes import side_by_side
from ..base.progress import Progress, no_progress
from ..base.units import si_key
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.nominal import NominalSound
from ..pipeline.study import chain_with
from ..radiation.cost import HIGH, LOW
from ..radiation.given import Radiation
from ..radiation.of_study import inputs_of
from ..stages.chain import Chain
from ..stages.radiation import modes_of, radiation_costs, transfer_vectors
from ..study.record import ParameterRecord
from ..study.selection import at_speeds
from ..study.study import Study

SHARE: Final = 0.2
"""Step of a value without a range, down and up, relative to it."""
LEVEL_DB: Final = float(level_of_amplitude(1.0 + SHARE))
"""Step of a level without a range: 20 % of its sound pressure."""
_LEVEL_UNITS: Final = ("dB", "dB(A)")
_NO_LEVEL: Final = "scoring"
"""Table whose values change scores, and no level."""


class Figures(NamedTuple):
    """Levels and force of one option at one microphone, or their changes.

    Attributes
    ----------
    total_dba : level with unmodelled noise
    modelled_dba : level without it
    force_1x_n : amplitude of the force at the shaft frequency
    """

    total_dba: float
    modelled_dba: float
    force_1x_n: float


class Move(NamedTuple):
    """A value of the template, and what it is moved to, in its unit."""

    record: ParameterRecord
    value: Any


@dataclass(frozen=True)
class Effect:
    """Effect of a value of the template, moved down and up.

    Attributes
    ----------
    record : the value
    ends : values that it is moved to; empty where it is not moved
    changes : changes of the figures at each end, dB and N; the reason where it is refused
    """

    record: ParameterRecord
    ends: tuple[Any, ...]
    changes: tuple[Figures | str, ...]

    @property
    def rank(self) -> tuple[float, float]:
        """Greatest change of a level, dB, and of the force, N; negative where it has none."""
        solved = [change for change in self.changes if isinstance(change, Figures)]
        level = [abs(value) for change in solved for value in change[:2]]
        return max([*level, -1.0]), max([*(abs(change.force_1x_n) for change in solved), -1.0])


@dataclass(frozen=True)
class Plan:
    """Runs that rank the values of a template, and what they cost.

    Attributes
    ----------
    study : study whose values are moved
    speed_rpm : speed of all figures, the nearest to that of the published level
    before : figures with the template's values, by option and microphone
    moves : one a run
    radiations : number of runs with a radiation of their own
    low_s, high_s : processor time of all runs, s
    """

    study: Study
    speed_rpm: float
    before: Mapping[tuple[str, str], Figures]
    moves: tuple[Move, ...]
    radiations: int
    low_s: float
    high_s: float


def planned(study: Study, radiation: Radiation = transfer_vectors) -> Plan:
    """Run a study once and estimate what the ranking of its template's values costs.

    Parameters
    ----------
    study : study from `load_study` or `coarse`
    radiation : function that gives the transfer vectors
    """
    moves = tuple(move for record in examples(study) for move in moves_of(record))
    published, options = study.catalogue_speed_rpm, tuple(study.options)
    speed_rpm = min(study.operation.speed_rpm, key=lambda speed_rpm: abs(speed_rpm - published))
    results = _chain(study, speed_rpm, options, radiation).results  # compiles, fills the cache
    cases = {case_of(study, record) for record in examples(study)}
    start = time.process_time()
    chain = _chain(study, speed_rpm, (REFERENCE_OPTION,), radiation)
    each_s = time.process_time() - start
    low_s, high_s = (spread * len(moves) * each_s for spread in (LOW, HIGH))
    radiating = _radiating(study, moves)
    radiations = sum(_table(move.record) in radiating for move in moves)
    if radiations and radiation is transfer_vectors:
        costs = radiation_costs(inputs_of(chain.study, modes_of(chain)))
        low_s += radiations * sum(cost.low_s for cost in costs)
        high_s += radiations * sum(cost.high_s for cost in costs)
    before = {case: _figures(results, *case) for case in cases}
    return Plan(study, speed_rpm, before, moves, radiations, low_s, high_s)


def ranked(
    plan: Plan, progress: Progress = no_progress, radiation: Radiation = transfer_vectors
) -> list[Effect]:
    """Move every value of the template; return the effects, the greatest first.

    Parameters
    ----------
    plan : plan from `planned`
    progress : function called with the advance
    radiation : function that gives the transfer vectors
    """
    study, task = plan.study, "values of the example"

    def change(move: Move) -> Figures | str:
        case = case_of(study, move.record)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                other = changed(study, move)
                chain = _chain(other, plan.speed_rpm, (REFERENCE_OPTION, case[0]), radiation)
            except (ParameterError, SolverError, FaultError) as error:
                return str(error)
        after = _figures(chain.results, *case)
        return Figures(*(new - old for new, old in zip(after, plan.before[case], strict=True)))

    changes: dict[str, list[Figures | str]] = {}
    progress(task, 0, len(plan.moves))
    for number, each in enumerate(side_by_side(change, plan.moves)):
        changes.setdefault(plan.moves[number].record.field, []).append(each)
        progress(task, number + 1, len(plan.moves))
    effects = []
    for record in examples(study):
        ends = tuple(move.value for move in moves_of(record))
        effects.append(Effect(record, ends, tuple(changes.get(record.field, ()))))
    return sorted(effects, key=lambda effect: effect.rank, reverse=True)


def examples(study: Study) -> list[ParameterRecord]:
    """Values that the study reads and that are the template's."""
    return [record for record in study.records if record.example]


def moves_of(record: ParameterRecord) -> list[Move]:
    """Values below and above: the ends of the range, else 20 % off, a level 1.6 dB.

    None for words, names of files, zeros without a range, and scales of scores.
    """
    value = _parsed(record.value)
    if _table(record) == _NO_LEVEL or value is None:
        return []
    if record.lowest is not None and not isinstance(value, list):
        ends: list[Any] = [record.lowest, record.highest]
    elif record.unit in _LEVEL_UNITS and not isinstance(value, list):
        ends = [value - LEVEL_DB, value + LEVEL_DB]
    else:
        ends = [_scaled(value, 1.0 - SHARE), _scaled(value, 1.0 + SHARE)]
    return [Move(record, end) for end in ends if end != value]


def changed(study: Study, move: Move) -> Study:
    """Return the study with a moved value; a field of whole numbers gets the next one outside.

    Raises
    ------
    ParameterError
        The study cannot have this value.
    """
    record, value = move
    limits = [record.lowest, record.highest] if record.lowest is not None else None
    range_ = {} if limits is None else {"range": limits}
    in_machine = si_key(_table(record))[0] in type(study.machine).model_fields
    prefix = "machine." if in_machine else ""

    def with_value(number: Any) -> Study:
        quantity = {"value": number, "source": record.source, **range_}
        return study.replace({f"{prefix}{record.field}": quantity})

    try:
        return with_value(value)
    except ParameterError:
        integer = None if isinstance(value, list) else _integer(value, float(record.value))
        if integer is None:
            raise
        return with_value(integer)


def case_of(study: Study, record: ParameterRecord) -> tuple[str, str]:
    """Option and microphone that show what a value does: its own, else the reference ones."""
    table, name, *_ = (*record.field.split("."), "")
    option = name if table == "options" else REFERENCE_OPTION
    return option, name if table == "receivers" else study.catalogue_receiver


def _chain(study: Study, speed_rpm: float, options: Sequence[str], radiation: Radiation) -> Chain:
    """Carry some options to their levels at a speed."""
    some = at_speeds(study, [speed_rpm], {name: study.options[name] for name in options})
    return chain_with(some, NominalSound, radiation=radiation)


def _figures(results: xr.Dataset, option: str, receiver: str) -> Figures:
    of_option = results.isel(speed=0).sel(option=option, weighting="A")
    total, modelled = (
        float(of_option[name].sel(receiver=receiver)) for name in ("level_total", "level_modelled")
    )
    return Figures(total, modelled, float(of_option["force_amplitude"].sel(order=1)))


def _radiating(study: Study, moves: Sequence[Move]) -> set[str]:
    """Tables of which a value, moved, changes what the radiation follows from."""
    differs: dict[str, bool] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for move in moves:
            with suppress(ParameterError):  # another move of the table decides
                if _table(move.record) not in differs:
                    differs[_table(move.record)] = _inputs(changed(study, move)) != _inputs(study)
    return {table for table, other in differs.items() if other}


def _inputs(study: Study) -> Any:
    """Return the inputs of the transfer vectors; of the modes, their table."""
    shell, receivers, settings, *_ = inputs_of(study, ())
    structure = getattr(study.machine, "structure", None) if study.drives_shell else None
    return shell, receivers, settings, structure


def _table(record: ParameterRecord) -> str:
    return record.field.partition(".")[0]


def _parsed(text: str) -> Any:
    """Number or list of numbers of a record's text; None for anything else."""
    try:
        value = json.loads(text)
    except ValueError:
        return None
    numbers = value if isinstance(value, list) else [value]
    is_number = all(isinstance(number, int | float) for number in numbers)
    return value if is_number and not isinstance(value, bool) else None


def _scaled(value: Any, factor: float) -> Any:
    return [factor * number for number in value] if isinstance(value, list) else factor * value


def _integer(value: float, before: float) -> int | None:
    """Return the next whole number, away from a value; None where it is the same."""
    integer = floor(value) if value < before else ceil(value)
    return integer if integer != before else None
