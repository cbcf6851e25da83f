"""Volume, absorption and reverberation time of a room."""

from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array
from .cutting import cut, faces
from .materials import OCTAVES_HZ, WAVE_OCTAVES
from .room import Room

LONGEST_S: Final = 5.0
"""Of rooms that hardly absorb."""


def volume_m3(room: Room) -> float:
    """Of the air, m³."""
    return float(sum(np.prod(box.size) for box in cut(room, np.inf, least_nodes=1)))


def absorption_area_m2(room: Room) -> Array:
    """Area times absorption, summed over walls and blocks, by octave, m²."""
    area = np.zeros(len(OCTAVES_HZ))
    for face in faces(room, cut(room, np.inf, least_nodes=1)):
        if face.material is not None:
            area += np.prod(face.upper - face.lower) * np.array(face.material.absorption)
    return area


def reverberation_time_s(room: Room) -> float:
    """The longest of the octaves that waves are computed in, T = 24 ln 10 V/(c A), s.

    H. Kuttruff, Room Acoustics, 6th edition (2016), equation 5.25 (Sabine); 5 s at most.
    """
    least = float(absorption_area_m2(room)[:WAVE_OCTAVES].min())
    volume = 24.0 * np.log(10.0) * volume_m3(room) / SPEED_OF_SOUND_M_PER_S
    return float(min(LONGEST_S, volume / least)) if least > 0.0 else LONGEST_S
