"""Speeds and options as cases: revolutions, what options add, loads of the sources."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.source import Case, Shared, Source
from ..mechanics.added import Added
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import Revolution
from ..sources.moving_parts import MovingParts
from ..study.study import Study
from ..uncertainty.draws import Draw, with_draw

At = tuple[float, str]
"""Speed in rpm and option."""

MOVING_PARTS = "moving_parts"
"""Name of the source that every study has."""


def cases_of(study: Study, progress: Progress) -> dict[At, Case]:
    """Every speed with every option, with the values as given."""
    operation = study.operation
    supplies = operation.supply_frequency_hz or (None,) * len(operation.speed_rpm)
    cases: dict[At, Case] = {}
    places = list(product(zip(operation.speed_rpm, supplies, strict=True), study.options))
    for number, ((speed, supply), name) in enumerate(places):
        option = study.options[name]
        machine = option.applied_to(study.machine)
        shared = cases.get((speed, REFERENCE_OPTION)) if machine is study.machine else None
        turned, added = _turned(study, name, speed, shared)
        cases[speed, name] = Case(
            machine, added, turned, supply, study.radiation.maximum_frequency_hz
        )
        progress("forces", number + 1, len(places))
    return cases


def _turned(
    study: Study, name: str, speed_rpm: float, shared: Case | None
) -> tuple[Revolution, Added]:
    """Steady revolution with an option, the reference's where it has one, and what it adds."""
    option = study.options[name]
    machine = option.applied_to(study.machine)
    samples = study.operation.crank_angle_samples
    try:
        turned = machine.revolution(speed_rpm, samples) if shared is None else shared.revolution
        return turned, option.added(machine, turned)
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


def with_values(cases: Mapping[At, Case], study: Study, draw: Draw) -> dict[At, Case]:
    """The cases with drawn values, and results of their own to share."""
    shared = Shared()
    return {
        at: replace(case, machine=with_draw(case.machine, study.machine, draw), shared=shared)
        for at, case in cases.items()
    }
