"""The cases of a study with drawn values: what moves otherwise turns anew."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby
from typing import Final

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..machine.source import Case, CaseKey, Shared
from ..mechanics.loads import Loads, PortLoads
from ..sources.cases import loads_of, without_time_series, wrench_lines
from ..study.draws import with_draw
from ..study.sampling import Draw
from ..study.study import Study
from .first_order import first_order

_SHELL: Final = {"shell", "structure", "variation", "frame", "shaft", "overall_noise", "remainder"}
"""Tables that say nothing of the motion."""


@dataclass(frozen=True)
class DrawnCases:
    """The cases of one draw.

    Attributes
    ----------
    cases : with drawn values, without courses over crank angle
    loads : of all sources in each
    wrenches : lines of the cases whose motion is not that as given, by source
    first_order : of the same, force, moment and foot force at 1x, N, N m, N
    """

    cases: dict[CaseKey, Case]
    loads: dict[CaseKey, dict[str, Loads]]
    wrenches: dict[CaseKey, dict[str, PortLoads]]
    first_order: dict[CaseKey, Array]


def drawn_cases(cases: Mapping[CaseKey, Case], study: Study, draw: Draw) -> DrawnCases:
    """The cases with drawn values; they share no result with those of other draws.

    Where a draw changes what moves, or the machine on its mounts, revolution and what an option
    adds are computed anew, and what the wrenches of the moving parts sound like.

    Parameters
    ----------
    cases : with the values as given, without their courses
    study : with its machine and options
    draw : values by table and field

    Raises
    ------
    ParameterError, SolverError
        A machine cannot run so, an option not be built, a source not act.
    """
    drawn = DrawnCases({}, {}, {}, {})
    shared = Shared()
    for _, of_speed in groupby(cases.items(), key=lambda item: item[0][0]):
        turned = Shared()  # let go with the speed: courses over crank angle are large
        for key, given in of_speed:
            machine = shared(
                id(given.machine), partial(with_draw, given.machine, study.machine, draw)
            )
            case = replace(given, machine=machine, shared=shared)
            if moves_otherwise(machine, given.machine, study):
                case = _turned(case, study, key, turned)
            loads = loads_of(study, case)
            if case.revolution.wrenches:
                highest = study.highest_order(case.speed_rpm)
                drawn.wrenches[key] = wrench_lines(case, loads, highest)
                drawn.first_order[key] = first_order(case, drawn.wrenches[key])
            drawn.cases[key], drawn.loads[key] = without_time_series(case, loads)
    return drawn


def moves_otherwise(machine: Machine, given: Machine, study: Study) -> bool:
    """Whether two machines differ in more than the shell and what sources alone read."""
    fields = type(machine).model_fields
    of_sources = {name for source in study.sources.values() for name in source.tables_read(machine)}
    still = _SHELL | {name for name in of_sources & set(fields) if not fields[name].is_required()}
    return any(
        getattr(machine, name) != getattr(given, name) for name in fields if name not in still
    )


def _turned(case: Case, study: Study, key: CaseKey, turned: Shared) -> Case:
    """A case with the revolution of its machine, which options that leave the machine share."""
    turn = partial(case.machine.revolution, case.speed_rpm, study.operation.crank_angle_samples)
    revolution = turned(id(case.machine), turn)
    try:
        added = study.option_of(key).added(case.machine, revolution)
    except ParameterError as error:
        raise ParameterError(f"options.{key[1]}: {error}") from None
    return replace(case, revolution=revolution, added=added)
