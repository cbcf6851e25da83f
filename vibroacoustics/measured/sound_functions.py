"""Sound pressure per force of a machine's hits or foot forces, from measured functions."""

from collections.abc import Sequence

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..recordings import MeasuredFunction, Node
from ..study.measured_sound_path import ForcePoint, MeasuredSoundPath
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.machine import MachineOnMounts, on_mounts
from .grouped import Key, by_key, read_all, unsigned
from .inversion import rigid_wrench

LEAST_SPAN = 1e-3
"""Least over largest singular value of hits that span all six motions, in lengths of 0.1 m."""
_LENGTH_M = 0.1


def force_sound_of(study: Study) -> ForceSound:
    """Read the measured pressure per force that a study names.

    Raises
    ------
    ParameterError
        The files do not fit, or the study needs what they do not hold.
    StorageError
        A file cannot be read.
    """
    settings = None if study.measured is None else study.measured.sound
    if settings is None:
        raise ParameterError("measured.sound: the study has no such table")
    fields = ("sound_power", "map", "directivity")
    unsupported = [name for name in fields if getattr(study, name) is not None]
    unsupported += ["operation.stopping"] * study.operation.stopping
    unsupported += ["sources that drive an elastic shell"] * study.drives_shell
    if unsupported:
        raise ParameterError(
            f"measured.sound: gives the sound of forces at the microphones alone; remove "
            f"{unsupported[0]}"
        )
    machine = on_mounts(study.machine)
    for name, option in study.options.items():
        if not settings.is_at_feet and on_mounts(option.built_into(study.machine)) != machine:
            raise ParameterError(
                f"measured.sound: options.{name}: stands otherwise than the machine that was hit; "
                "hit the floor under the feet, or leave the option out"
            )
    sound = read_force_sound(settings, list(study.receivers), machine)
    lowest = shaft_frequency_hz(min(study.operation.speed_rpm))
    if sound.frequency_hz[0] > lowest:
        raise ParameterError(
            f"measured.sound: begins at {sound.frequency_hz[0]:g} Hz, above the first order, "
            f"{lowest:g} Hz"
        )
    return sound


def read_force_sound(
    settings: MeasuredSoundPath, receivers: Sequence[str], body: MachineOnMounts
) -> ForceSound:
    """Pressure per force as the study's receivers have it, repeats averaged.

    Raises
    ------
    ParameterError
        A function is missing, or in a wrong unit, or differs in its frequencies; hits do not span
        the six motions of a machine, or a foot is none of the machine's.
    StorageError
        A file cannot be read.
    """
    groups = by_key(read_all(settings.frequency_responses, settings.units))
    points = list(settings.points.values())
    functions = [
        [_measured(settings.microphones[name].node, point, groups) for point in points]
        for name in receivers
    ]
    frequency = functions[0][0][0]
    for row in functions:
        for hertz, _ in row:
            if hertz.shape != frequency.shape or not np.allclose(hertz, frequency):
                raise ParameterError("measured.sound: functions differ in their frequencies")
    pressure = np.array([[values for _, values in row] for row in functions])
    if settings.is_at_feet:
        return ForceSound(body, frequency, None, _by_foot(points, pressure, body.stand.names))
    return ForceSound(body, frequency, _by_wrench(points, pressure), None)


def _by_foot(
    points: Sequence[ForcePoint], pressure: ComplexArray, feet: Sequence[str]
) -> ComplexArray:
    """Shape (receiver, foot, axis, frequency); along axes that were not hit there is no sound."""
    values = np.zeros((len(pressure), len(feet), 3, pressure.shape[-1]), dtype=complex)
    for number, point in enumerate(points):
        if point.foot not in feet:
            raise ParameterError(
                f"measured.sound.points: no foot {point.foot}; there are {', '.join(feet)}"
            )
        axis = "xyz".index(point.direction[1])
        values[:, feet.index(point.foot), axis] = _sign(point) * pressure[:, number]
    return values


def _by_wrench(points: Sequence[ForcePoint], pressure: ComplexArray) -> ComplexArray:
    """Response of the least forces at the points that make a wrench, shape (receiver, 6,
    frequency)."""
    positions = np.array([(point.x_m, point.y_m, point.z_m) for point in points], dtype=float)
    directions = np.array(
        [[_sign(point) * float(point.direction[1] == axis) for axis in "xyz"] for point in points]
    )
    wrench = rigid_wrench(positions, directions)
    scaled = wrench / np.array([1.0] * 3 + [_LENGTH_M] * 3)[:, None]
    sizes = np.linalg.svd(scaled, compute_uv=False)
    spanned = int(np.sum(sizes > LEAST_SPAN * sizes[0]))
    if spanned < 6:
        raise ParameterError(
            f"measured.sound.points: hits span {spanned} of the six motions of the machine; hit it "
            "at more points or along more axes"
        )
    return np.asarray(np.einsum("rpf,pw->rwf", pressure, np.linalg.pinv(wrench)))


def _sign(point: ForcePoint) -> float:
    return -1.0 if point.direction[0] == "-" else 1.0


def _measured(
    microphone: int, point: ForcePoint, groups: dict[Key, list[MeasuredFunction]]
) -> tuple[Array, ComplexArray]:
    """Frequencies and pressure per force along the positive direction, Pa/N."""
    response, node = Node(microphone), unsigned(Node(point.node, point.direction))
    functions = groups.get(("frequency response", response, node))
    if functions is None:
        raise ParameterError(
            f"measured.sound: frequency response {response}/{node} is in none of the files"
        )
    first = functions[0].frequency_hz
    for function in functions:
        if (function.response_unit, function.reference_unit) != ("Pa", "N"):
            raise ParameterError(
                f"measured.sound: {function}: in {function.response_unit}/"
                f"{function.reference_unit}, must be Pa/N"
            )
        if function.frequency_hz.shape != first.shape or not np.allclose(
            function.frequency_hz, first
        ):
            raise ParameterError(f"measured.sound: {function}: repeats differ in their frequencies")
    return first, np.asarray(np.mean([function.values for function in functions], axis=0))
