"""A study on a measured floor: mobility under the feet of a machine from measured functions."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..machine.floor import FloorMobility
from ..machine.machine import Machine
from ..machine.option import Option
from ..recordings import MeasuredFunction, Node
from ..study.baseline import FloorPoint, MeasuredFloor
from ..study.study import Study
from ..transfer import on_mounts
from .grouped import Key, by_key, read_all, unsigned


def read_floor(settings: MeasuredFloor, feet: Sequence[str]) -> FloorMobility:
    """Driving-point mobilities, repeats averaged, as the table that a machine's file names.

    Raises
    ------
    ParameterError
        A function is missing, or in a wrong unit; a foot has none, or is none of the machine's.
    StorageError
        A file cannot be read.
    """
    groups = by_key(read_all(settings.frequency_responses, settings.units))
    names, rows = [], []
    for foot in dict.fromkeys(point.foot for point in settings.points.values()):
        table = _of_foot([p for p in settings.points.values() if p.foot == foot], groups)
        names += [foot] * len(table)
        rows.append(table)
    frequency, *columns = np.concatenate(rows).T
    files = ", ".join(Path(name).name for name in settings.frequency_responses)
    mobility = FloorMobility(
        file=files,
        foot=tuple(names),
        frequency_hz=tuple(frequency.tolist()),
        vertical_m_per_ns=tuple(columns[0].tolist()),
        vertical_phase_rad=tuple(columns[1].tolist()),
        lateral_m_per_ns=tuple(columns[2].tolist()),
        lateral_phase_rad=tuple(columns[3].tolist()),
    )
    reason = mobility.why_not_under(feet)
    if reason:
        raise ParameterError(f"measured.floor: {reason}")
    return mobility


def _of_foot(points: Sequence[FloorPoint], groups: dict[Key, list[MeasuredFunction]]) -> Array:
    """Frequency, then amplitude and phase up and down and sideways, shape (frequency, 5)."""
    by_axis = {point.is_vertical: _driving_point(point, groups) for point in points}
    frequency, vertical = by_axis[True]
    lateral: ComplexArray = np.zeros(frequency.size, dtype=complex)
    if False in by_axis:
        sideways_hz, values = by_axis[False]
        if sideways_hz[0] > frequency[0] or sideways_hz[-1] < frequency[-1]:
            raise ParameterError(
                f"measured.floor: {points[0].foot}: sideways from {sideways_hz[0]:g} to "
                f"{sideways_hz[-1]:g} Hz, must cover {frequency[0]:g} to "
                f"{frequency[-1]:g} Hz as up and down"
            )
        lateral = np.interp(frequency, sideways_hz, values)
    columns = [frequency, *(part(each) for each in (vertical, lateral) for part in (abs, np.angle))]
    return np.stack(columns, axis=1)


def _driving_point(
    point: FloorPoint, groups: dict[Key, list[MeasuredFunction]]
) -> tuple[Array, ComplexArray]:
    """Frequencies and complex mobility, m/(N s)."""
    node = unsigned(Node(point.node, point.direction))
    functions = groups.get(("frequency response", node, node))
    if functions is None:
        raise ParameterError(
            f"measured.floor: frequency response {node}/{node} of {point.foot} is in none of the "
            "files"
        )
    first = functions[0].frequency_hz
    for function in functions:
        if function.reference_unit != "N":
            raise ParameterError(
                f"measured.floor: {function}: reference in {function.reference_unit}: "
                "must be a force, N"
            )
        if function.frequency_hz.shape != first.shape or not np.allclose(
            function.frequency_hz, first
        ):
            raise ParameterError(f"measured.floor: {function}: repeats differ in their frequencies")
    mobilities = [function.with_response_in("m/s").values for function in functions]
    return first, np.asarray(np.mean(mobilities, axis=0))


def on_measured_floor(study: Study) -> Study:
    """The study with the measured mobility under the feet of its machine, in every option."""
    settings = None if study.measured is None else study.measured.floor
    if settings is None:
        return study
    mobility = read_floor(settings, on_mounts(study.machine).stand.names)
    at_catalogue = study.catalogue_machine
    return study.model_copy(
        update={
            "machine": _on(mobility, study.machine, "machine"),
            "catalogue_machine": at_catalogue and _on(mobility, at_catalogue, "machine"),
            "options": {
                name: _option_on(mobility, option, study.machine, f"options.{name}.change")
                for name, option in study.options.items()
            },
        }
    )


def _option_on(mobility: FloorMobility, option: Option, machine: Machine, where: str) -> Option:
    changed = option.applied_to(machine)
    if changed is machine:
        return option
    return option.model_copy(update={"machine": _on(mobility, changed, where)})


def _on(mobility: FloorMobility, machine: Machine, where: str) -> Machine:
    if machine.floor is not None or machine.floor_mobility is not None:
        table = "floor" if machine.floor is not None else "floor_mobility"
        raise ParameterError(f"measured.floor: {where}.{table}: is a floor too; leave one out")
    reason = mobility.why_not_under(on_mounts(machine).stand.names)
    if reason:
        raise ParameterError(f"measured.floor: {where}: {reason}")
    return machine.model_copy(update={"floor_mobility": mobility})
