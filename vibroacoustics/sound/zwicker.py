"""Loudness of stationary sound from third octaves, over arrays of spectra (ISO 532-1, Zwicker).

Tables are those of ISO 532-1:2017, Annex A (A.3 to A.9), as in its program. Values are not rounded.
"""

from typing import Final, Literal, NamedTuple

import numpy as np

from ..base.arrays import Array
from ..base.decibel import amplitude_of_level, level_of_power, power_of_level
from ..base.errors import ParameterError

SoundField = Literal["free", "diffuse"]
"""Field in which the ears are: sound from the front, or from everywhere (ISO 532-1)."""
LOUDEST_DB: Final = 120.0
"""Highest level of a third octave below 300 Hz for which the method holds."""
_RANGE_DB: Final = np.array([45.0, 55.0, 65.0, 71.0, 80.0, 90.0, 100.0])
"""Upper ends of the ranges of corrected levels at low frequencies."""
_LOW_DB: Final = np.array([
    (-32, -24, -16, -10, -5, 0, -7, -3, 0, -2, 0),
    (-29, -22, -15, -10, -4, 0, -7, -2, 0, -2, 0),
    (-27, -19, -14, -9, -4, 0, -6, -2, 0, -2, 0),
    (-25, -17, -12, -9, -3, 0, -5, -2, 0, -2, 0),
    (-23, -16, -11, -7, -3, 0, -4, -1, 0, -1, 0),
    (-20, -14, -10, -6, -3, 0, -4, -1, 0, -1, 0),
    (-18, -12, -9, -6, -2, 0, -3, -1, 0, -1, 0),
    (-15, -10, -8, -4, -2, 0, -3, -1, 0, -1, 0),
], dtype=float)  # fmt: skip
"""Corrections of the third octaves from 25 to 250 Hz by range of level, (range, band)."""
_LOW_BANDS: Final = (slice(0, 6), slice(6, 9), slice(9, 11))
"""Third octaves of the three lowest critical bands."""
_THRESHOLD_DB: Final = np.array(
    [30, 18, 12, 8, 7, 6, 5, 4, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3], dtype=float
)
_EAR_DB: Final = np.array([
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.5, -1.6, -3.2, -5.4, -5.6, -4.0, -1.5, 2.0, 5.0, 12.0,
])  # fmt: skip
_DIFFUSE_DB: Final = np.array([
    0, 0, 0.5, 0.9, 1.2, 1.6, 2.3, 2.8, 3.0, 2.0, 0, -1.4, -2.0, -1.9, -1.0, 0.5, 3.0, 4.0, 4.3,
    4.0,
])  # fmt: skip
_WIDTH_DB: Final = np.array([
    -0.25, -0.6, -0.8, -0.8, -0.5, 0, 0.5, 1.1, 1.5, 1.7, 1.8, 1.8, 1.7, 1.6, 1.4, 1.2, 0.8, 0.5,
    0, -0.5,
])  # fmt: skip
"""Level of a third octave over that of the critical band at its frequency."""
UPPER_EDGE_BARK: Final = np.array([
    0.9, 1.8, 2.8, 3.5, 4.4, 5.4, 6.6, 7.9, 9.2, 10.6, 12.3, 13.8, 15.2, 16.7, 18.1, 19.3, 20.6,
    21.8, 22.7, 23.6, 24.0,
])  # fmt: skip
"""Upper edges of the critical bands; the last band has no core loudness."""
_KNOT: Final = np.array([
    21.5, 18.0, 15.1, 11.5, 9.0, 6.1, 4.4, 3.1, 2.13, 1.36, 0.82, 0.42, 0.30, 0.22, 0.15, 0.10,
    0.035, 0.0,
])  # fmt: skip
"""Lower ends of the ranges of specific loudness with one steepness of the slope, sone/Bark."""
_STEEPNESS: Final = np.array([
    (13.0, 8.2, 6.3, 5.5, 5.5, 5.5, 5.5, 5.5),
    (9.0, 7.5, 6.0, 5.1, 4.5, 4.5, 4.5, 4.5),
    (7.8, 6.7, 5.6, 4.9, 4.4, 3.9, 3.9, 3.9),
    (6.2, 5.4, 4.6, 4.0, 3.5, 3.2, 3.2, 3.2),
    (4.5, 3.8, 3.6, 3.2, 2.9, 2.7, 2.7, 2.7),
    (3.7, 3.0, 2.8, 2.35, 2.2, 2.2, 2.2, 2.2),
    (2.9, 2.3, 2.1, 1.9, 1.8, 1.7, 1.7, 1.7),
    (2.4, 1.7, 1.5, 1.35, 1.3, 1.3, 1.3, 1.3),
    (1.95, 1.45, 1.3, 1.15, 1.1, 1.1, 1.1, 1.1),
    (1.5, 1.2, 0.94, 0.86, 0.82, 0.82, 0.82, 0.82),
    (0.72, 0.67, 0.64, 0.63, 0.62, 0.62, 0.62, 0.62),
    (0.59, 0.53, 0.51, 0.50, 0.42, 0.42, 0.42, 0.42),
    (0.40, 0.33, 0.26, 0.24, 0.22, 0.22, 0.22, 0.22),
    (0.27, 0.21, 0.20, 0.18, 0.17, 0.17, 0.17, 0.17),
    (0.16, 0.15, 0.14, 0.12, 0.11, 0.11, 0.11, 0.11),
    (0.12, 0.11, 0.10, 0.08, 0.08, 0.08, 0.08, 0.08),
    (0.09, 0.08, 0.07, 0.06, 0.06, 0.06, 0.06, 0.05),
    (0.06, 0.05, 0.03, 0.02, 0.02, 0.02, 0.02, 0.02),
])  # fmt: skip
"""Steepness of the upper slope, (range, band), sone/Bark²; further bands have the last column."""
_TOP_SONE: Final = 1e4
"""Specific loudness above any that 120 dB give, sone/Bark."""


class _Slope(NamedTuple):
    """Slope of specific loudness towards higher frequencies in one critical band.

    Attributes
    ----------
    loudness : rising knots of specific loudness, shape (knot,), sone/Bark
    distance : over which the slope falls from each knot to zero, shape (knot,), Bark
    area : below the slope over this distance, shape (knot,), sone
    """

    loudness: Array
    distance: Array
    area: Array

    @classmethod
    def of(cls, steepness: Array) -> "_Slope":
        """Integrate dn/dz = -s(n), where s is constant between knots."""
        knot = np.append(_KNOT[::-1], _TOP_SONE)
        rising = steepness[::-1]
        distance = np.append(0.0, np.cumsum(np.diff(knot) / rising))
        area = np.append(0.0, np.cumsum(0.5 * np.diff(knot**2) / rising))
        return cls(knot, distance, area)

    def distance_of(self, loudness: Array) -> Array:
        """Distance over which the slope falls to zero, Bark."""
        return np.interp(loudness, self.loudness, self.distance)

    def area_of(self, loudness: Array) -> Array:
        """Area below the slope to zero, sone: linear in the square of specific loudness."""
        return np.interp(loudness**2, self.loudness**2, self.area)

    def loudness_at(self, distance: Array) -> Array:
        """Specific loudness at a distance before zero, sone/Bark."""
        return np.interp(distance, self.distance, self.loudness)


_SLOPES: Final = tuple(
    _Slope.of(_STEEPNESS[:, min(max(band - 1, 0), 7)]) for band in range(UPPER_EDGE_BARK.size)
)


def core_loudness(level_db: Array, field: SoundField = "free") -> Array:
    """Compute the core loudness of the critical bands (ISO 532-1, A.3 to A.6), sone/Bark.

    Parameters
    ----------
    level_db : levels of the third octaves from 25 Hz to 12.5 kHz, shape (..., 28), dB
    field : free or diffuse

    Returns
    -------
    shape (..., 20)

    Raises
    ------
    ParameterError
        A third octave below 300 Hz exceeds 120 dB.
    """
    low_db = level_db[..., : _LOW_DB.shape[1]]
    loudest = float(low_db.max(initial=-np.inf))
    if loudest > LOUDEST_DB:
        raise ParameterError(
            f"loudness: a third octave below 300 Hz has {loudest:.4g} dB; ISO 532-1 holds up to "
            f"{LOUDEST_DB:g} dB"
        )
    low = power_of_level(low_db + _low_correction_db(low_db))
    lowest = np.stack([low[..., bands].sum(axis=-1) for bands in _LOW_BANDS], axis=-1)
    band_db = np.concatenate([level_of_power(lowest), level_db[..., 11:]], axis=-1) - _EAR_DB
    if field == "diffuse":
        band_db = band_db + _DIFFUSE_DB
    over_db = band_db - _THRESHOLD_DB
    growth = (0.75 + 0.25 * power_of_level(over_db - _WIDTH_DB)) ** 0.25 - 1.0
    scale = 0.0635 * amplitude_of_level(0.5 * _THRESHOLD_DB)
    core = np.where(over_db > 0.0, scale * np.maximum(growth, 0.0), 0.0)
    core[..., 0] *= np.minimum(0.4 + 0.32 * core[..., 0] ** 0.2, 1.0)
    return core


def _low_correction_db(level_db: Array) -> Array:
    """Correction of the third octaves up to 250 Hz by their level, the same shape, dB."""
    correction = np.broadcast_to(_LOW_DB[0], level_db.shape)
    for number, upper in enumerate(_RANGE_DB):
        above = level_db > upper - _LOW_DB[number]
        correction = np.where(above, _LOW_DB[number + 1], correction)
    return correction


def total_loudness(core: Array) -> Array:
    """Compute the loudness below the core loudness and its upper slopes, shape (...), sone.

    In each critical band the specific loudness is the larger of the core loudness and the slope
    that falls from the band below (ISO 532-1, A.7). Both are integrated in closed form.

    Parameters
    ----------
    core : core loudness, shape (..., 20), sone/Bark
    """
    before: Array = np.zeros(core.shape[:-1])
    total = np.zeros(core.shape[:-1])
    widths = np.diff(UPPER_EDGE_BARK, prepend=0.0)
    for band, (slope, width) in enumerate(zip(_SLOPES, widths.tolist(), strict=True)):
        level = core[..., band] if band < core.shape[-1] else np.zeros(core.shape[:-1])
        start = np.maximum(before, level)
        begin = slope.distance_of(start)
        end = np.maximum(slope.loudness_at(begin - width), level)
        flat = width - (begin - slope.distance_of(end))
        total += slope.area_of(start) - slope.area_of(end) + level * flat
        before = end
    return total


def specific_loudness(core: Array, bark: Array) -> Array:
    """Return the specific loudness at critical-band rates, shape (..., bark), sone/Bark.

    Parameters
    ----------
    core : core loudness, shape (..., 20), sone/Bark
    bark : rising critical-band rates, 0 to 24, shape (bark,), Bark
    """
    specific = np.zeros((*core.shape[:-1], bark.size))
    before: Array = np.zeros(core.shape[:-1])
    lower = 0.0
    for band, (slope, upper) in enumerate(zip(_SLOPES, UPPER_EDGE_BARK.tolist(), strict=True)):
        level = core[..., band] if band < core.shape[-1] else np.zeros(core.shape[:-1])
        begin = slope.distance_of(np.maximum(before, level))
        in_band = (bark > lower + _ROUNDING) & (bark <= upper + _ROUNDING)
        falling = slope.loudness_at(begin[..., None] - (bark[in_band] - lower))
        specific[..., in_band] = np.maximum(falling, level[..., None])
        before = np.maximum(slope.loudness_at(begin - (upper - lower)), level)
        lower = upper
    return specific


def lower_edge_bark(third: int) -> float:
    """Return the lower edge of the critical band of a third octave, counted from that at 25 Hz."""
    for band, thirds in enumerate(_LOW_BANDS):
        if third < thirds.stop:
            return float(UPPER_EDGE_BARK[band - 1]) if band else 0.0
    return float(UPPER_EDGE_BARK[third - _LOW_BANDS[-1].stop + len(_LOW_BANDS) - 1])


_ROUNDING: Final = 1e-9
