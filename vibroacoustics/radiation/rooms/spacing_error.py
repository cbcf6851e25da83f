"""Error of a room by its spacing: what changes when the spacing is halved."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ...base.decibel import level_of_power
from ...base.progress import Progress, no_progress
from ..arrays import Array, ComplexArray
from .lattice import Lattice
from .response import room_transfer
from .room import Room
from .settings import RoomSettings


def spacing_error_db(
    room: Room,
    lattices: Sequence[Lattice],
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    settings: RoomSettings | None = None,
    progress: Progress = no_progress,
) -> dict[str, Array]:
    """Level of the room minus that with half the spacing, by microphone, (frequency, point), dB.

    The finer run takes sixteen times the work. Errors fall with the spacing's square, so that the
    difference is some four thirds of the error that is left: it is published as it is.
    """
    settings = settings or RoomSettings()
    finer = replace(settings, nodes_per_wave=2.0 * settings.nodes_per_wave)
    of = (room, lattices, microphones, frequency_hz)
    coarse, fine = (room_transfer(*of, one, progress=progress) for one in (settings, finer))
    return {name: _difference_db(coarse[name].values, fine[name].values) for name in microphones}


def _difference_db(coarse: Sequence[ComplexArray], fine: Sequence[ComplexArray]) -> Array:
    parts = [
        level_of_power(np.abs(a[:, 0]) ** 2 / np.abs(b[:, 0]) ** 2).reshape(a.shape[0], -1)
        for a, b in zip(coarse, fine, strict=True)
    ]
    return np.concatenate(parts, axis=1)
