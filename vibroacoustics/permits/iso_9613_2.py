"""Attenuation outdoors of ISO 9613-2:1996 by octaves: distance, air, ground, one screen."""

from typing import Final, NamedTuple

import numpy as np

from ..base.air_attenuation import air_attenuation_per_m
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude, level_of_power, power_of_level

OCTAVES_HZ: Final[Array] = np.array([63.0, 125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0])
A_WEIGHTING_DB: Final[Array] = np.array([-26.2, -16.1, -8.6, -3.2, 0.0, 1.2, 1.0, -1.1])
"""A-weighting at nominal octaves (IEC 61672-1, table 3)."""
LARGEST_SCREEN_DB: Final = 20.0
"""Largest attenuation by one edge (clause 7.4)."""


class Path(NamedTuple):
    """Straight way from a source to a receiver.

    Attributes
    ----------
    distance_m : horizontal distance
    source_height_m, receiver_height_m : heights above the ground
    """

    distance_m: float
    source_height_m: float
    receiver_height_m: float

    @property
    def slant_m(self) -> float:
        """Distance between source and receiver."""
        return float(np.hypot(self.distance_m, self.source_height_m - self.receiver_height_m))


class Ground(NamedTuple):
    """Ground factors, 0 of hard to 1 of porous ground.

    Attributes
    ----------
    source, middle, receiver : factors of the three regions
    """

    source: float
    middle: float
    receiver: float


class Screen(NamedTuple):
    """One edge on the straight way, higher than the line of sight or not.

    Attributes
    ----------
    from_source_m : horizontal distance from the source
    height_m : height of the edge above the ground
    """

    from_source_m: float
    height_m: float


def divergence_db(slant_m: float) -> float:
    """A_div = 20 lg(d/1 m) + 11 dB (equation 7)."""
    return level_of_amplitude(slant_m) + 11.0


def atmosphere_db(slant_m: float, temperature_k: float, humidity_ratio: float) -> Array:
    """A_atm of the air at exact midband frequencies by ISO 9613-1, shape (octave,), dB.

    Parameters
    ----------
    slant_m : distance
    temperature_k : temperature
    humidity_ratio : relative humidity
    """
    steps = np.arange(-4.0, 4.0, dtype=np.float64)
    exact_hz = 1000.0 * power_of_level(3.0 * steps)
    per_m = air_attenuation_per_m(exact_hz, temperature_k, humidity_ratio)
    return np.asarray(-level_of_power(np.exp(-slant_m * per_m)))


def ground_db(path: Path, ground: Ground) -> Array:
    """A_gr of the general method, shape (octave,), dB (clause 7.3.1, table 3).

    Parameters
    ----------
    path : way over flat ground
    ground : factors of the regions
    """
    reach = 30.0 * (path.source_height_m + path.receiver_height_m)
    q = 0.0 if path.distance_m <= reach else 1.0 - reach / path.distance_m
    middle = -3.0 * q * (1.0 - ground.middle) * np.ones(OCTAVES_HZ.size)
    middle[0] = -3.0 * q
    return np.asarray(
        _region(path.source_height_m, path.distance_m, ground.source)
        + _region(path.receiver_height_m, path.distance_m, ground.receiver)
        + middle
    )


def _region(height_m: float, distance_m: float, factor: float) -> Array:
    """A_s or A_r, shape (octave,), dB."""
    h, d = height_m, distance_m
    far = 1.0 - np.exp(-d / 50.0)
    form = np.array([
        1.5 + 3.0 * np.exp(-0.12 * (h - 5.0) ** 2) * far
        + 5.7 * np.exp(-0.09 * h**2) * (1.0 - np.exp(-2.8e-6 * d**2)),
        1.5 + 8.6 * np.exp(-0.09 * h**2) * far,
        1.5 + 14.0 * np.exp(-0.46 * h**2) * far,
        1.5 + 5.0 * np.exp(-0.9 * h**2) * far,
    ])  # fmt: skip
    return np.concatenate([
        [-1.5], -1.5 + factor * form, np.full(3, -1.5 * (1.0 - factor)),
    ])  # fmt: skip


def alternative_ground_db(path: Path) -> float:
    """A_gr of the alternative method for A-weighted levels, dB (equation 10).

    A_gr = 4.8 - (2 h_m/d)(17 + 300/d), not below zero.
    """
    mean_height = 0.5 * (path.source_height_m + path.receiver_height_m)
    d = path.slant_m
    return float(max(4.8 - 2.0 * mean_height / d * (17.0 + 300.0 / d), 0.0))


def reflection_db(path: Path) -> float:
    """D_Ω of the ground near the source, with the alternative method, dB (equation 11)."""
    square = path.distance_m**2
    less = square + (path.source_height_m - path.receiver_height_m) ** 2
    more = square + (path.source_height_m + path.receiver_height_m) ** 2
    return level_of_power(1.0 + less / more)


def screen_db(path: Path, screen: Screen) -> Array:
    """D_z of one edge, with ground by image sources, shape (octave,), dB (equations 14 to 18).

    Parameters
    ----------
    path : way without the screen
    screen : edge
    """
    before = np.hypot(screen.from_source_m, screen.height_m - path.source_height_m)
    behind = np.hypot(
        path.distance_m - screen.from_source_m, screen.height_m - path.receiver_height_m
    )
    longer = float(before + behind - path.slant_m)
    rise = path.receiver_height_m - path.source_height_m
    sight_m = path.source_height_m + rise * screen.from_source_m / path.distance_m
    if screen.height_m < sight_m:
        longer = -longer
    weather = 1.0
    if longer > 0.0:
        weather = float(np.exp(-np.sqrt(before * behind * path.slant_m / (2.0 * longer)) / 2000.0))
    ratio: Array = 3.0 + 20.0 * longer * weather * OCTAVES_HZ / 340.0
    return np.asarray(np.minimum(level_of_power(np.maximum(ratio, 1.0)), LARGEST_SCREEN_DB))


def octave_levels_db(
    power_db: Array,
    path: Path,
    ground: Ground | None,
    temperature_k: float,
    humidity_ratio: float,
    screen: Screen | None = None,
) -> Array:
    """Compute downwind octave levels at the receiver, shape (octave,), dB (equations 3 and 4).

    Parameters
    ----------
    power_db : sound power levels, shape (octave,), dB
    path : way from source to receiver
    ground : factors of the general method; None takes the alternative method
    temperature_k, humidity_ratio : temperature and relative humidity of the air
    screen : one edge between them
    """
    if ground is None:
        of_ground: Array = np.full(OCTAVES_HZ.size, alternative_ground_db(path))
        directivity = reflection_db(path)
    else:
        of_ground, directivity = ground_db(path, ground), 0.0
    if screen is not None:
        over_edge = screen_db(path, screen)
        barrier = np.maximum(over_edge - np.maximum(of_ground, 0.0), 0.0)
        of_ground = of_ground + barrier
    attenuation = (
        divergence_db(path.slant_m)
        + atmosphere_db(path.slant_m, temperature_k, humidity_ratio)
        + of_ground
    )
    return np.asarray(power_db + directivity - attenuation)
