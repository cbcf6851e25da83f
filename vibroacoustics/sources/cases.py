"""Speeds and options as cases: revolutions, what options add, loads of the sources."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from itertools import product
from math import isfinite
from typing import ClassVar, Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import MACHINES, Machine
from ..machine.option import OPTIONS, Option
from ..machine.source import SOURCES, Case, CaseKey, Source
from ..mechanics.added import Added
from ..mechanics.loads import Loads, PortLoads
from ..mechanics.moving_parts import Revolution, Wrench, wrench
from ..mechanics.ports import BodyPort
from ..orders.spectrum import order_spectra
from ..study.study import Study

MOVING_PARTS: Final = "moving_parts"
"""Name of the source that every study has."""
ADDED_MASS: Final = "added_mass_kg"


class MovingParts(Source):
    """Always there; a study does not name it."""

    kind: ClassVar[str] = "moving-parts"
    position: ClassVar[float] = 0.0
    label: ClassVar[str] = "moving parts (orders of the rigid machine)"

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Wrenches of the machine's parts by name, and of the option's as `balancer`."""
        balancer = wrench(case.added.parts, case.revolution.rotation)
        return Loads(wrenches={**case.revolution.wrenches, "balancer": balancer})


def cases_of(study: Study, progress: Progress) -> dict[CaseKey, Case]:
    """Return every speed with every option, with nominal values."""
    operation = study.operation
    supplies = operation.supply_frequency_hz or (None,) * len(operation.speed_rpm)
    points = list(product(zip(operation.speed_rpm, supplies, strict=True), study.options))
    cases: dict[CaseKey, Case] = {}
    progress("forces", 0, len(points))
    for number, ((speed, supply), name) in enumerate(points):
        option = study.options[name]
        is_changed = option.applied_to(study.machine) is not study.machine
        shared = None if is_changed else cases.get((speed, REFERENCE_OPTION))
        machine = option.built_into(study.machine)
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
        steady = _turning(machine, speed_rpm, samples) if shared is None else shared.revolution
        option = study.options[name]
        return steady, added_by(option, machine, steady)
    except ParameterError as error:
        raise ParameterError(f"options.{name}: {error}") from None


def added_by(option: Option, machine: Machine, revolution: Revolution) -> Added:
    """Return what an option adds, with the mass of the bodies that it attaches.

    Parameters
    ----------
    option : whose shapes are checked
    machine : with the option built into it
    revolution : revolution of the machine
    """
    with OPTIONS.fenced(option.kind, ParameterError):
        added = option.added(machine, revolution)
        check_added(added, revolution.rotation.crank_angle.size)
    mass_kg = added.figures[ADDED_MASS] + option.attached(machine).mass_kg
    return replace(added, figures={**added.figures, ADDED_MASS: mass_kg})


def _turning(machine: Machine, speed_rpm: float, samples: int) -> Revolution:
    """Steady revolution of a machine, its shapes checked."""
    with MACHINES.fenced(machine.kind, ParameterError):
        revolution = machine.revolution(speed_rpm, samples)
        check_revolution(revolution, samples)
    return revolution


def sources_of(study: Study) -> dict[str, Source]:
    """All sources by name, in the order in which they act."""
    named = {MOVING_PARTS: MovingParts(), **study.sources}
    return dict(sorted(named.items(), key=lambda item: getattr(item[1], "position", 1000.0)))


def loads_of(study: Study, case: Case) -> dict[str, Loads]:
    """Loads of all sources in one case."""
    return _loaded(study, case)[1]


def loaded_cases(
    study: Study, cases: Mapping[CaseKey, Case]
) -> tuple[dict[CaseKey, Case], dict[CaseKey, dict[str, Loads]]]:
    """The cases with the supply of the motor, and the loads of all sources in each.

    A supply that the study does not give is derived of the reference option and holds for all
    options at the speed: a balancer does not change the mains.
    """
    supplied: dict[CaseKey, Case] = {}
    loads: dict[CaseKey, dict[str, Loads]] = {}
    for key in sorted(cases, key=lambda key: key[1] != REFERENCE_OPTION):
        reference = supplied.get((key[0], REFERENCE_OPTION), cases[key])
        case = replace(cases[key], supply_frequency_hz=reference.supply_frequency_hz)
        supplied[key], loads[key] = _loaded(study, case)
    return {key: supplied[key] for key in cases}, {key: loads[key] for key in cases}


def _loaded(study: Study, case: Case) -> tuple[Case, dict[str, Loads]]:
    loads: dict[str, Loads] = {}
    for name, source in sources_of(study).items():
        try:
            if case.supply_frequency_hz is None:
                case = _on_supply(case, source.supply_frequency_hz(case, dict(loads)))
            with SOURCES.fenced(source.kind, ParameterError):
                loads[name] = source.loads(case, dict(loads))
                check_loads(loads[name], case.revolution.rotation.crank_angle.size)
            _check_ports(source, loads[name])
        except ParameterError as error:
            raise ParameterError(f"sources.{name}: {error}") from None
    return case, loads


def _check_ports(source: Source, loads: Loads) -> None:
    """Refuse loads in an elastic shell, of which the study does not know."""
    for port in loads.ports:
        if not isinstance(port, BodyPort) and not source.drives_shell:
            raise ParameterError(
                f"loads the port {port.name} in the elastic shell; its class needs "
                "drives_shell = True"
            )


def _on_supply(case: Case, frequency_hz: float | None) -> Case:
    """The case on a derived supply, whose line at twice its frequency must be modelled."""
    if frequency_hz is not None and 2.0 * frequency_hz > case.maximum_frequency_hz:
        raise ParameterError(
            f"radiation.maximum_frequency_hz = {case.maximum_frequency_hz:g} Hz: twice the supply "
            f"frequency is {2.0 * frequency_hz:.4g} Hz at {case.speed_rpm:g} rpm"
        )
    return replace(case, supply_frequency_hz=frequency_hz)


def wrench_lines(
    case: Case, loads: Mapping[str, Loads], highest_order: int
) -> dict[str, PortLoads]:
    """Lines of the wrenches over crank angle by source, on the body with the mechanism."""
    speed, port = case.revolution.rotation.speed_rad_per_s, case.machine.mechanism_port

    def spectrum(wrenches: Collection[Wrench]) -> ComplexArray:
        each = [order_spectra(np.concatenate(wrench), speed, highest_order) for wrench in wrenches]
        return np.asarray(np.sum(each, axis=0))

    return {
        source: {port: spectrum(load.wrenches.values())}
        for source, load in loads.items()
        if load.wrenches
    }


def without_time_series(case: Case, loads: Mapping[str, Loads]) -> tuple[Case, dict[str, Loads]]:
    """Case and loads without wrenches and paths over crank angle, which the results hold."""
    bare = replace(
        case,
        revolution=replace(case.revolution, wrenches={}),
        added=replace(case.added, parts=()),
    )
    return bare, {name: replace(load, wrenches={}) for name, load in loads.items()}


def check_revolution(revolution: Revolution, samples: int) -> None:
    """Refuse a revolution whose time histories are not over the crank angles."""
    _check_history("rotation", revolution.rotation.speed_rad_per_s, (samples,))
    _check_wrenches(revolution.wrenches, samples)


def check_added(added: Added, samples: int) -> None:
    """Refuse what has no added mass, or a path that is not over the crank angles.

    Raises
    ------
    ValueError
        Names the figure or the part.
    """
    if not isfinite(added.figures.get(ADDED_MASS, float("nan"))):
        raise ValueError(f"figures: need a finite {ADDED_MASS}")
    for part in added.parts:
        _check_history(part.source, part.position_m, (3, samples))


def check_loads(loads: Loads, samples: int) -> None:
    """Refuse wrenches not over the crank angles, and lines not of a port's components.

    Raises
    ------
    ValueError
        Names the wrench or the port.
    """
    _check_wrenches(loads.wrenches, samples)
    for port, spectrum in loads.lines.items():
        if spectrum.ndim != 2 or len(spectrum) != len(port.components):
            raise ValueError(
                f"{port.name}: shape {spectrum.shape}, must be ({len(port.components)}, order)"
            )


def _check_wrenches(wrenches: Mapping[str, Wrench], samples: int) -> None:
    for name, of_source in wrenches.items():
        for history in of_source:
            _check_history(name, history, (3, samples))


def _check_history(name: str, history: Array | ComplexArray, shape: Iterable[int]) -> None:
    if history.shape != tuple(shape):
        raise ValueError(f"{name}: shape {history.shape}, must be {tuple(shape)}")
