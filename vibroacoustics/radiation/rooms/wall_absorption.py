"""Absorption of a room's surfaces: what is requested and what its waves are computed with."""

import warnings
from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.vocabulary import stamped
from ..arrays import Array
from .impedance import fitted_absorption
from .room import HARD, MOST_ABSORPTION, OCTAVES_HZ, SIDES, WAVE_OCTAVES, Material, Room

MOST_DIFFERENCE: Final = 0.03
"""Largest difference from the requested absorption without a warning."""


class AbsorptionWarning(UserWarning):
    """Waves meet a surface of another absorption than the requested one."""


def wall_absorption(room: Room, highest_hz: float) -> xr.Dataset:
    """Return requested and computed absorption of every surface, by octave.

    Returns
    -------
    `room_wall_absorption` and `room_wall_absorption_requested` (room_surface, room_octave); the
    former is not a number in octaves above the waves
    """
    surfaces = dict(_surfaces(room))
    coords = {"room_surface": list(surfaces), "room_octave": list(OCTAVES_HZ)}
    values = {
        "room_wall_absorption": [computed(surface, highest_hz) for surface in surfaces.values()],
        "room_wall_absorption_requested": [surface.absorption for surface in surfaces.values()],
    }
    return stamped(values, coords)


def computed(material: Material, highest_hz: float) -> Array:
    """Return the absorption of a material in the waves, by octave; not a number above them."""
    absorption = np.full(len(OCTAVES_HZ), np.nan)
    absorption[:WAVE_OCTAVES] = 0.0 if material.hard else fitted_absorption(material)
    return np.where(np.array(OCTAVES_HZ) <= highest_hz, absorption, np.nan)


def warn_of_absorption(room: Room, highest_hz: float) -> None:
    """Warn of surfaces whose computed absorption differs from the requested one."""
    surfaces: dict[Material, list[str]] = {}
    for name, material in _surfaces(room):
        surfaces.setdefault(material, []).append(f"room.{name}")
    for material, names in surfaces.items():
        absorption = computed(material, highest_hz)
        octaves = [
            f"{value:.2f} instead of {requested:g} at {octave:g} Hz"
            for octave, value, requested in zip(
                OCTAVES_HZ, absorption, material.absorption, strict=True
            )
            if abs(value - requested) > MOST_DIFFERENCE
        ]
        if octaves:
            most = f"; a locally reacting wall absorbs at most {MOST_ABSORPTION:g}"
            clipped = most if material.clipped_octaves_hz else ""
            warnings.warn(
                f"{', '.join(names)}: absorption of waves is {', '.join(octaves)}{clipped}",
                AbsorptionWarning,
                stacklevel=3,
            )


def _surfaces(room: Room) -> Iterator[tuple[str, Material]]:
    """Surfaces by their key below `room` in a study."""
    yield from ((f"walls.{side}", room.walls.get(side, HARD)) for side in SIDES)
    yield from ((f"furniture.{block.name}", block.material) for block in room.blocks)
    yield from ((f"patches.{patch.name}", patch.material) for patch in room.patches)
