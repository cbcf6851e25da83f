"""Speeds and options as cases: revolutions, what options add, loads of the sources."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import Final

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import Machine
from ..machine.source import Case, CaseKey, Source
from ..mechanics.added import Added
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import Revolution
from ..study.study import Study
from .moving_parts import MovingParts

MOVING_PARTS: Final = "moving_parts"
"""Name of the source that every study has."""


def cases_of(study: Study, progress: Progress) -> dict[CaseKey, Case]:
    """Every speed with every option, with the values as given."""
    operation = study.operation
    supplies = operation.supply_frequency_hz or (None,) * len(operation.speed_rpm)
    points = list(product(zip(operation.speed_rpm, supplies, strict=True), study.options))
    cases: dict[CaseKey, Case] = {}
    for number, ((speed, supply), name) in enumerate(points):
        machine = study.options[name].applied_to(study.machine)
        shared = cases.get((speed, REFERENCE_OPTION)) if machine is study.machine else None
        revolution, added = _revolution(study, name, machine, speed, shared)
        cases[speed, name] = Case(
            machine, added, revolution, supply, study.radiation.maximum_frequency_hz
        )
        progress("forces", number + 1, len(points))
    return cases


def _revolution(
    study: Study, name: str, machine: Machine, speed_rpm: float, shared: Case | None
) -> tuple[Revolution, Added]:
    """Steady revolution with an option, the reference's where it has one, and what it adds."""
    samples = study.operation.crank_angle_samples
    try:
        steady = machine.revolution(speed_rpm, samples) if shared is None else shared.revolution
        return steady, study.options[name].added(machine, steady)
    except ParameterError as error:
        raise ParameterError(f"options.{name}: {error}") from None


def sources_of(study: Study) -> dict[str, Source]:
    """All sources by name, in the order in which they act."""
    named = {MOVING_PARTS: MovingParts(), **study.sources}
    return dict(sorted(named.items(), key=lambda item: getattr(item[1], "position", 1000.0)))


def loads_of(study: Study, case: Case) -> dict[str, Loads]:
    """Loads of all sources in one case.

    Raises
    ------
    ParameterError
        A source cannot act so.
    """
    loads: dict[str, Loads] = {}
    for name, source in sources_of(study).items():
        try:
            loads[name] = source.loads(case, dict(loads))
        except ParameterError as error:
            raise ParameterError(f"sources.{name}: {error}") from None
    return loads


def sources_of_wrenches(loads: Mapping[str, Loads]) -> dict[str, str]:
    """Source of each wrench, by the wrench's name."""
    return {wrench: source for source, load in loads.items() for wrench in load.wrenches}


def without_time_series(case: Case, loads: Mapping[str, Loads]) -> tuple[Case, dict[str, Loads]]:
    """Case and loads without wrenches and paths over crank angle, which the results hold."""
    bare = replace(
        case,
        revolution=replace(case.revolution, wrenches={}),
        added=replace(case.added, parts=()),
    )
    return bare, {name: replace(load, wrenches={}) for name, load in loads.items()}
