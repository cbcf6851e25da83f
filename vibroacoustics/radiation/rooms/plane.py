"""Sound of a monopole over a plane of a room, by waves: a map of where it is loud."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, IndexArray
from ...base.constants import (
    AIR_IMPEDANCE_PA_S_PER_M,
    REFERENCE_POWER_W,
    REFERENCE_PRESSURE_PA,
    SPEED_OF_SOUND_M_PER_S,
)
from ...base.decibel import mean_square_level
from ...base.progress import Progress, no_progress
from ...base.vocabulary import stamped
from .lattice import Lattice
from .room import Room
from .run import room_transfer
from .settings import RoomSettings

LATTICE_M: Final = 0.2
"""Distance of the points of a map at most."""


def plane_gains(
    room: Room,
    source_m: Array,
    above_floor_m: float,
    height_m: float,
    bands_hz: Mapping[float, Array],
    maximum_frequency_hz: float,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Level at the points of a plane over the power level of a monopole, in bands.

    The monopole's power is that over a hard floor in the open, A²/(4π ρ c) (1 + sin(2kh)/(2kh))
    (F. Jacobsen and P. M. Juhl, Fundamentals of General Linear Acoustics (2013), section 9.4).

    Parameters
    ----------
    room : its furniture is omitted from the map
    source_m : the monopole, shape (3,)
    above_floor_m : height of the monopole over what it stands on
    height_m : height of the plane
    bands_hz : frequencies that stand for each band, alike in number, by its nominal middle
    maximum_frequency_hz : maximum frequency of the waves; bands beyond it are omitted
    progress : told of the advance

    Returns
    -------
    `room_map_gain` (room_map_y, room_map_x, seam_band), dB; not a number in furniture
    """
    bands = {name: of for name, of in bands_hz.items() if of.max() <= maximum_frequency_hz}
    frequency = np.concatenate(list(bands.values()))
    x, y = (_line(size) for size in room.size_m[:2])
    rows = _free_rows(room, x, y, height_m)
    lattices = [Lattice(x[row], y[[j]], np.array([height_m])) for j, row in rows]
    settings = RoomSettings(maximum_frequency_hz)
    response = room_transfer(
        room, lattices, {"map": source_m}, frequency, settings, progress=progress
    )["map"]
    k = 2.0 * np.pi * frequency / SPEED_OF_SOUND_M_PER_S
    over_floor = 1.0 + np.sinc(2.0 * k * above_floor_m / np.pi)
    per_power = 4.0 * np.pi * AIR_IMPEDANCE_PA_S_PER_M / over_floor
    gain = np.full((y.size, x.size, len(bands)), np.nan)
    for (j, row), value in zip(rows, response.values, strict=True):
        square = np.abs(value[:, 0, :, 0, 0]) ** 2 * per_power[:, None]
        mean = square.reshape(len(bands), -1, square.shape[1]).mean(axis=1)
        gain[j, row] = mean_square_level(mean.T * REFERENCE_POWER_W, REFERENCE_PRESSURE_PA)
    coords = {"room_map_y": y, "room_map_x": x, "seam_band": list(bands)}
    return stamped({"room_map_gain": gain}, coords)


def _line(size_m: float) -> Array:
    """Points between two walls, half a distance off each."""
    count = int(np.ceil(size_m / LATTICE_M))
    return (np.arange(count) + 0.5) * size_m / count


def _free_rows(room: Room, x: Array, y: Array, height_m: float) -> list[tuple[int, IndexArray]]:
    """Number of each row along y and the numbers of neighbouring points along x in the air."""
    rows = []
    for j, across in enumerate(y):
        free = np.array([_in_air(room, (along, across, height_m)) for along in x])
        numbers = np.flatnonzero(free)
        parts = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
        rows += [(j, part) for part in parts if part.size]
    return rows


def _in_air(room: Room, point: tuple[float, float, float]) -> bool:
    return not any(
        all(
            low <= coordinate <= high
            for low, coordinate, high in zip(block.lower, point, block.upper, strict=True)
        )
        for block in room.blocks
    )
