"""The diffuse field of a room, where waves are not computed, and its crossover to the waves."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.air_attenuation import air_attenuation_per_m
from ...base.constants import AIR_IMPEDANCE_PA_S_PER_M, SPEED_OF_SOUND_M_PER_S
from ...base.decibel import level_of_power
from ..arrays import Array
from .cutting import cut, faces
from .room import OCTAVES_HZ, WAVE_OCTAVES, Room

CROSSOVER_HZ: Final = (400.0, 630.0)
"""Crossover frequencies: below, waves alone; above, the diffuse field alone."""
_MOST_MEAN_ABSORPTION: Final = 0.99
_NEAREST_M: Final = 0.05
LONGEST_S: Final = 5.0
"""Longest reverberation time, of rooms that hardly absorb."""


@dataclass(frozen=True)
class DiffuseRoom:
    """Room for a diffuse field."""

    absorption_area_m2: Array
    """Absorption area by octave from 63 Hz to 4 kHz, (octave,)."""
    surface_m2: float
    """Surface of walls and blocks."""
    volume_m3: float
    """Volume of the air."""

    @classmethod
    def of(cls, room: Room) -> "DiffuseRoom":
        """Return the diffuse room of a room."""
        return cls(absorption_area_m2(room), surface_m2(room), volume_m3(room))

    def area_m2(self, frequency_hz: Array) -> Array:
        """Absorption area of walls and air, A + 4 m V, (frequency,), m².

        H. Kuttruff, Room Acoustics, 6th edition (2016), section 5.1. Octaves are interpolated over
        the logarithm of the frequency; the first and the last hold beyond. m is the absorption of
        air at 20 °C and 50 % relative humidity.
        """
        octaves = np.log(OCTAVES_HZ)
        walls = np.interp(np.log(frequency_hz), octaves, self.absorption_area_m2)
        return np.asarray(walls + 4.0 * air_attenuation_per_m(frequency_hz) * self.volume_m3)

    def constant_m2(self, frequency_hz: Array) -> Array:
        """Room constant R = A/(1 - A/S), (frequency,), m²; A/S is 0.99 at most."""
        area = self.area_m2(frequency_hz)
        return np.asarray(area / (1.0 - np.minimum(area / self.surface_m2, _MOST_MEAN_ABSORPTION)))

    def reverberation_time_s(self, frequency_hz: Array) -> Array:
        """Reverberation time of walls and air, T = 24 ln 10 V/(c A), (frequency,), s; 5 s at most.

        H. Kuttruff, Room Acoustics, 6th edition (2016), equation 5.25 (Sabine).
        """
        volume = 24.0 * np.log(10.0) * self.volume_m3 / SPEED_OF_SOUND_M_PER_S
        return np.asarray(volume / np.maximum(self.area_m2(frequency_hz), volume / LONGEST_S))


def surface_m2(room: Room) -> float:
    """Area of all walls and blocks that air meets, m²."""
    boxes = cut(room, np.inf, least_nodes=1)
    sides = sum(2.0 * float(np.prod(box.size) * np.sum(1.0 / box.size)) for box in boxes)
    seams = (face for face in faces(room, boxes) if len(face.ends) == 2)
    return sides - sum(2.0 * float(np.prod(face.upper - face.lower)) for face in seams)


def mean_square_per_power(
    frequency_hz: Array, distance_m: float, room: DiffuseRoom, in_sight: bool
) -> Array:
    """Mean square pressure over sound power, rho c [1/(2 pi r²) + 4/R], (frequency,), Pa²/W.

    H. Kuttruff, Room Acoustics, 6th edition (2016), section 5.5, with R for A; the machine stands
    on a hard surface and sends all its power into half the space. Where a block stands between,
    no direct sound is left.

    Parameters
    ----------
    frequency_hz : frequencies above 0, shape (frequency,)
    distance_m : from the machine to the listener; 0.05 m at least is taken
    room : its absorption
    in_sight : whether the machine is in the listener's sight: see `line_of_sight`
    """
    reflected = AIR_IMPEDANCE_PA_S_PER_M * 4.0 / room.constant_m2(frequency_hz)
    return np.asarray(direct_per_power(distance_m, in_sight) + reflected)


def direct_per_power(distance_m: float, in_sight: bool) -> float:
    """The part of the direct sound in `mean_square_per_power`, Pa²/W."""
    distance_m = max(distance_m, _NEAREST_M)
    return AIR_IMPEDANCE_PA_S_PER_M / (2.0 * np.pi * distance_m**2) if in_sight else 0.0


def line_of_sight(room: Room, start: Array, end: Array) -> bool:
    """Whether no block stands between two points (3,)."""
    path = np.subtract(end, start)
    for block in room.blocks:
        with np.errstate(divide="ignore", invalid="ignore"):
            to_planes = np.array([block.lower, block.upper] - np.asarray(start)) / path
        parallel = path == 0.0
        beside = (np.asarray(start) <= block.lower) | (np.asarray(start) >= block.upper)
        if np.any(parallel & beside):
            continue
        entering = np.where(parallel, 0.0, to_planes.min(axis=0)).max()
        leaving = np.where(parallel, 1.0, to_planes.max(axis=0)).min()
        if max(entering, 0.0) < min(leaving, 1.0) - 1e-9:
            return False
    return True


def blend(frequency_hz: Array) -> Array:
    """Weight of the diffuse field: 0 below 400 Hz, 1 above 630 Hz, smooth in between.

    3 x² - 2 x³ over the logarithm of the frequency. With it, mean squares of the waves and of the
    diffuse field are added.
    """
    low, high = np.log(CROSSOVER_HZ)
    with np.errstate(divide="ignore"):
        x = np.clip((np.log(frequency_hz) - low) / (high - low), 0.0, 1.0)
    return np.asarray(x**2 * (3.0 - 2.0 * x))


def gain_at_position_db(waves: Array, diffuse: Array) -> float:
    """Level of the waves above the diffuse field, dB: what the place does to the power sent out.

    A machine in a corner or a niche sends out another power than in the open. The mean of the
    ratios of both mean squares over all listeners and third octaves; added to the diffuse field,
    both have the same energy at the crossover.

    Parameters
    ----------
    waves, diffuse : mean square pressures, shape (listener, third octave), Pa²; those without sound
        are omitted
    """
    sounding = (waves > 0.0) & (diffuse > 0.0)
    if not sounding.any():
        return 0.0
    return float(level_of_power(float(np.mean(waves[sounding] / diffuse[sounding]))))


def volume_m3(room: Room) -> float:
    """Return the volume of the air, m³."""
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
