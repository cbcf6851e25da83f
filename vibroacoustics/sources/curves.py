"""Inner curves of a machine and of the sources that drive it, as one dataset."""

from collections.abc import Iterator
from itertools import chain

import xarray as xr

from ..base.curves import Curve, curves_dataset
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import Machine
from ..machine.option import Option
from ..machine.source import Case
from ..study.study import Study

LEAST_RPM, GREATEST_RPM = 60.0, 60000.0


def curves(
    study_or_machine: Study | Machine,
    speed_rpm: float | None = None,
    option: str = REFERENCE_OPTION,
) -> xr.Dataset:
    """Return inner curves of a machine: pressures, films, friction, torques, critical speeds.

    Parameters
    ----------
    study_or_machine : a study, whose sources have curves too; or a machine alone
    speed_rpm : mean over time; None for the study's first speed, or that of the machine's overall
        noise
    option : option of the study; a redesign changes the machine, another one what acts on the
        sources

    Returns
    -------
    one variable a curve, in SI; the attribute `read_in` is the unit of tables and pictures,
    `source` the document and figure that the curve repeats

    Raises
    ------
    ParameterError
        The speed or the option cannot be, or neither machine nor sources have curves.
    SolverError
        No steady motion is found.

    Examples
    --------
    >>> import vibroacoustics as va
    >>> machine = va.load_machine("data/machines/mayekawa_wbhe.toml")
    >>> inner = va.curves(machine, speed_rpm=1000.0)
    >>> best = inner["best_design"].sel(length="bore", design_speed=1000.0)
    >>> f"{1e3 * best.item():.1f} mm"
    '129.9 mm'
    """
    study = study_or_machine if isinstance(study_or_machine, Study) else None
    base = study_or_machine if isinstance(study_or_machine, Machine) else study_or_machine.machine
    speed = _speed(study, base) if speed_rpm is None else speed_rpm
    if not LEAST_RPM <= speed <= GREATEST_RPM:
        raise ParameterError(
            f"speed_rpm = {speed:g} rpm: allowed {LEAST_RPM:g} to {GREATEST_RPM:g} rpm"
        )
    changed = _option(study, option)
    machine = base if changed is None else changed.applied_to(base)
    attrs = {
        "title": f"Curves of {machine.name} at {speed:g} rpm",
        "machine": machine.name,
        "machine_kind": machine.kind,
        "option": option,
        "speed_rpm": speed,
    }
    parts = [machine.curves(speed)]
    if study is not None and changed is not None and study.sources:
        parts.append(_of_sources(study, machine, changed, speed))
    dataset = curves_dataset(chain.from_iterable(parts), attrs)
    if not dataset.data_vars:
        raise ParameterError(f"machine {machine.name}: its kind {machine.kind} has no curves")
    return dataset


def _speed(study: Study | None, machine: Machine) -> float:
    if study is not None:
        return study.operation.speed_rpm[0]
    if machine.overall_noise is None:
        raise ParameterError(
            f"speed_rpm = missing: machine {machine.name} gives no overall_noise with a speed"
        )
    return machine.overall_noise.speed_rpm


def _option(study: Study | None, name: str) -> Option | None:
    """The option of a study; None for a machine alone, which has only the reference."""
    options = {} if study is None else study.options
    if name in options:
        return options[name]
    if study is None and name == REFERENCE_OPTION:
        return None
    allowed = ", ".join(options) or f"{REFERENCE_OPTION}, as there is no study"
    raise ParameterError(f"option = {name}: unknown; allowed {allowed}")


def _of_sources(
    study: Study, machine: Machine, option: Option, speed_rpm: float
) -> Iterator[Curve]:
    """Curves of all sources of a study, in the order in which they act."""
    revolution = machine.revolution(speed_rpm, study.operation.crank_angle_samples)
    case = Case(
        machine=machine,
        added=option.added(machine, revolution),
        revolution=revolution,
        supply_frequency_hz=_supply(study, speed_rpm),
        maximum_frequency_hz=study.radiation.maximum_frequency_hz,
    )
    for source in sorted(
        study.sources.values(), key=lambda source: getattr(source, "position", 1000.0)
    ):
        yield from source.curves(case)


def _supply(study: Study, speed_rpm: float) -> float | None:
    """Supply frequency of a speed that the study lists."""
    supplies = study.operation.supply_frequency_hz
    if supplies is None or speed_rpm not in study.operation.speed_rpm:
        return None
    return supplies[study.operation.speed_rpm.index(speed_rpm)]
