"""The room of a study, its machine and its listeners, and pressure at all that is asked for."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.constants import AIR_IMPEDANCE_PA_S_PER_M
from ...base.decibel import power_of_level
from ...base.progress import Progress
from ...base.vocabulary import RIGID_BODY_DOFS, stamped
from ...machine.shell import Shell
from ...study.room import Covering, StudyRoom
from ...study.study import Study
from ..interpolation import interpolant
from ..patterns import SurfaceMotion
from ..transfer_vectors import cache_key_material
from .diffuse import (
    CROSSOVER_HZ,
    DiffuseRoom,
    absorption_area_m2,
    blend,
    direct_per_power,
    gain_at_position_db,
    line_of_sight,
    mean_square_per_power,
)
from .impedance import wall_absorption
from .machine_in_room import green_of_foot, room_pressure_per_velocity, room_vectors
from .plane import plane_gains
from .room import OCTAVES_HZ, Block, Material, Patch, Room

_KEPT: Final = 8
"""Sets of frequencies whose values are kept: rigid motions and modes ask for the same."""
SHOWN_FROM_HZ: Final = 250.0
"""Lowest third octave in which both methods are shown."""
PressureAt = Callable[[Array], ComplexArray]
"""Function of frequencies, (frequency,), to (place, pattern, frequency), Pa per unit velocity."""


@dataclass(frozen=True)
class Arrivals:
    """First sound at the listeners.

    Attributes
    ----------
    distance_m : from the source, also where furniture hides it, shape (listener,)
    per_power : mean square of the direct sound per power, 0 without sight, shape (listener,), Pa²/W
    """

    distance_m: Array
    per_power: Array


def room_of(settings: StudyRoom) -> Room:
    """Walls, furniture and patches as the solver takes them."""
    return Room(
        settings.size_m,
        {side: _material(side, covering) for side, covering in settings.walls.items()},
        tuple(
            Block(name, block.lower_m, block.upper_m, _material(name, block.material))
            for name, block in settings.furniture.items()
        ),
        tuple(
            Patch(name, patch.side, patch.lower_m, patch.upper_m, _material(name, patch.material))
            for name, patch in settings.patches.items()
        ),
    )


def _material(name: str, covering: Covering) -> Material:
    """Material with the octave of 63 Hz as that of 125 Hz (assumed)."""
    values = covering.absorption_ratio
    return Material(covering.name or name, (values[0], *values), covering.source)


def foot_m(settings: StudyRoom) -> Array:
    """Return the foot of the shell's axis on what it stands on, shape (3,)."""
    return np.array([*settings.foot_m, settings.standing_height_m])


def machine_middle_m(settings: StudyRoom, shell: Shell) -> Array:
    """Centre of the shell's volume, shape (3,)."""
    up = shell.profile.centroid_z_m - shell.floor_z_m
    return np.asarray(foot_m(settings) + np.array([0.0, 0.0, up]))


def listeners_m(settings: StudyRoom) -> dict[str, Array]:
    """Return the position of each listener by name, shape (3,)."""
    return {
        name: np.array([listener.x_m, listener.y_m, listener.height_m])
        for name, listener in settings.listeners.items()
    }


def room_key(study: Study, settings: StudyRoom, motions: Sequence[SurfaceMotion]) -> dict[str, Any]:
    """Everything that shapes the room's vectors, as plain data to be hashed."""
    machine = cache_key_material(study.machine.shell, {}, study.radiation, motions=motions)
    return {"machine": machine, "room": settings.model_dump(exclude={"limits"})}


def vectors_in_room(
    study: Study, settings: StudyRoom, motions: Sequence[SurfaceMotion], progress: Progress
) -> xr.Dataset:
    """Compute `room_vectors` of a study's machine at the listeners in its room."""
    return room_vectors(
        study.machine.shell,
        study.radiation,
        room_of(settings),
        foot_m(settings),
        listeners_m(settings),
        settings.maximum_frequency_hz,
        motions,
        progress,
    )


def map_height_m(settings: StudyRoom) -> float:
    """Return the height of the ears of the first listener, in whose plane sound is mapped."""
    return next(iter(settings.listeners.values())).height_m


def plane_key(study: Study, settings: StudyRoom, bands_hz: Mapping[float, Array]) -> dict[str, Any]:
    """Return everything that shapes `plane_in_room`, as plain data to be hashed."""
    plane = [map_height_m(settings), *map(list, bands_hz.values())]
    return {**room_key(study, settings, ()), "plane": plane}


def plane_in_room(
    study: Study, settings: StudyRoom, bands_hz: Mapping[float, Array], progress: Progress
) -> xr.Dataset:
    """Compute `plane_gains` of the middle of a study's machine."""
    middle_m, height_m = machine_middle_m(settings, study.machine.shell), map_height_m(settings)
    above_m = float(middle_m[2] - settings.standing_height_m)
    return plane_gains(
        room_of(settings), middle_m, above_m, height_m, bands_hz, settings.maximum_frequency_hz,
        progress,
    )  # fmt: skip


def pressure_at_positions(vectors: xr.Dataset) -> PressureAt:
    """Pressure at the listeners by waves, then at the positions on the hemisphere.

    Above the waves' highest frequency the listeners get none.
    """
    waves = room_pressure_per_velocity(vectors)
    highest_hz = float(vectors.attrs["room_maximum_frequency_hz"])
    table = vectors["hemisphere_transfer_vector"]
    table = table.transpose("hemisphere_position", "pattern", "frequency")
    radius_m = np.full((table.shape[0], 1), float(vectors.attrs["hemisphere_radius_m"]))
    positions = interpolant(table["frequency"].values, table.values, radius_m)
    listeners = vectors.sizes["listener"]

    @lru_cache(maxsize=_KEPT)
    def kept(frequency: bytes) -> ComplexArray:
        hertz = np.frombuffer(frequency)
        shape = (listeners + table.shape[0], table.shape[1], hertz.size)
        values = np.zeros(shape, dtype=complex)
        low = hertz <= highest_hz
        values[:listeners, :, low] = waves(hertz[low])
        values[listeners:] = positions(hertz)
        values.flags.writeable = False
        return values

    return lambda frequency_hz: kept(np.asarray(frequency_hz, dtype=np.float64).tobytes())


def of_rigid(pressure: PressureAt) -> PressureAt:
    """The rigid motions among the patterns."""
    return lambda frequency_hz: pressure(frequency_hz)[:, : len(RIGID_BODY_DOFS)]


def of_modes(pressure: PressureAt) -> PressureAt:
    """The shell's modes among the patterns."""
    return lambda frequency_hz: pressure(frequency_hz)[:, len(RIGID_BODY_DOFS) :]


def wave_share(highest_hz: float) -> Callable[[Array], Array]:
    """Share of the waves in mean squares, of frequencies.

    From the waves to the power over the crossover frequencies; lower by a factor where the waves
    end below them.
    """
    return lambda frequency_hz: np.asarray(1.0 - blend(frequency_hz / crossover_shift(highest_hz)))


def crossover_shift(highest_hz: float) -> float:
    """Factor on the crossover frequencies where waves end below it."""
    return min(1.0, highest_hz / CROSSOVER_HZ[1])


def diffuse_per_power(
    settings: StudyRoom, source_m: Array, gain: Callable[[Array], Array] = np.ones_like
) -> Callable[[Array], Array]:
    """Mean square of pressure per power at the listeners by direct sound and diffuse field.

    Parameters
    ----------
    settings : settings of the room
    source_m : where the sound comes from, shape (3,)
    gain : gain of the power at its position, a function of frequencies

    Returns
    -------
    of frequencies, shape (listener, frequency), Pa²/W
    """
    room = room_of(settings)
    diffuse = DiffuseRoom.of(room)
    sights = [
        (float(np.linalg.norm(ears_m - source_m)), line_of_sight(room, source_m, ears_m))
        for ears_m in listeners_m(settings).values()
    ]

    def per_power(frequency_hz: Array) -> Array:
        return np.asarray(
            gain(frequency_hz)
            * np.array(
                [
                    mean_square_per_power(frequency_hz, away, diffuse, sight)
                    for away, sight in sights
                ]
            )
        )

    return per_power


def plate_per_power(settings: StudyRoom, vectors: xr.Dataset) -> Callable[[Array], Array]:
    """Mean square of pressure at the listeners per power of the plate that the feet push.

    The plate is a volume velocity Q beside the machine's foot, of the power ρ ω²|Q|²/(4π c) that it
    has over a hard surface in the open (assumed). By waves it gives the pressure jωρ Q G, so that a
    mean square per power is 2π ρ c |G|²; above them direct sound and diffuse field.

    Returns
    -------
    of frequencies, shape (listener, frequency), Pa²/W
    """
    highest_hz = float(vectors.attrs["room_maximum_frequency_hz"])
    share, diffuse = wave_share(highest_hz), diffuse_per_power(settings, foot_m(settings))
    green = green_of_foot(vectors)

    def per_power(frequency_hz: Array) -> Array:
        low = frequency_hz <= highest_hz
        waves = np.zeros((len(settings.listeners), frequency_hz.size))
        waves[:, low] = np.abs(green(frequency_hz[low])) ** 2
        waves *= 2.0 * np.pi * AIR_IMPEDANCE_PA_S_PER_M
        part = share(frequency_hz)
        return np.asarray(part * waves + (1.0 - part) * diffuse(frequency_hz))

    return per_power


def crossover_bands_hz(highest_hz: float) -> tuple[float, float]:
    """Lowest and highest midband frequency that is shown around the crossover, Hz."""
    return SHOWN_FROM_HZ * crossover_shift(highest_hz), highest_hz


def position_gains_db(waves: Array, diffuse: Array) -> Array:
    """Level of the power at the machine's place over that in the open, (shown band + 1,), dB.

    For each third octave that is shown, the mean over the listeners; the last one, of all of them
    together, holds above the waves.

    Parameters
    ----------
    waves, diffuse : mean squares per power in these bands, shape (listener, shown band)
    """
    parts = [np.array([number]) for number in range(waves.shape[1])] + [np.arange(waves.shape[1])]
    return np.array([gain_at_position_db(waves[:, part], diffuse[:, part]) for part in parts])


def gain_over_frequency(gains_db: Array, middle_hz: Array) -> Callable[[Array], Array]:
    """Factor on the power, of frequencies; over the logarithm between the bands."""
    log_middle_hz = np.log([*middle_hz, middle_hz[-1] * 2.0 ** (1.0 / 3.0)])
    return lambda frequency_hz: np.asarray(
        power_of_level(np.interp(np.log(frequency_hz), log_middle_hz, gains_db))
    )


def surface_variables(settings: StudyRoom) -> xr.Dataset:
    """Label the absorption of a room and of its surfaces, and the limits of its listeners."""
    room, limits = room_of(settings), settings.limits.levels
    values: dict[str, Any] = {"room_absorption_area": absorption_area_m2(room)}
    if limits:
        values["room_limit"] = list(limits.values())
    coords = {"room_octave": list(OCTAVES_HZ), "room_limit_time": list(limits)}
    return stamped(values, coords).merge(wall_absorption(room, settings.maximum_frequency_hz))


def arrivals(settings: StudyRoom, source_m: Array) -> Arrivals:
    """First sound of a source at the listeners.

    Parameters
    ----------
    settings : settings of the room
    source_m : where the sound comes from, shape (3,)
    """
    room, ears_m = room_of(settings), list(listeners_m(settings).values())
    away = np.array([np.linalg.norm(ear_m - source_m) for ear_m in ears_m])
    sights = [line_of_sight(room, source_m, ear_m) for ear_m in ears_m]
    direct = [direct_per_power(float(far), sight) for far, sight in zip(away, sights, strict=True)]
    return Arrivals(away, np.array(direct))
