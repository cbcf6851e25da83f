"""Loudness of stationary sound (ISO 532-1, Zwicker) and sharpness (DIN 45692)."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..levels.bands import HALF_BAND, bands_between, measurable_bands
from .ingredients import Ingredients
from .recorded import NarrowBands
from .zwicker import (
    SoundField,
    core_loudness,
    lower_edge_bark,
    specific_loudness,
    total_loudness,
)

BANDS: Final = bands_between(3, 25.0, 12500.0)
CENTRES_HZ: Final[Array] = np.array([band.middle_hz for band in BANDS])
"""Exact midband frequencies of the third octaves from 25 Hz to 12.5 kHz."""
_ACROSS: Final = 20
_SILENT_DB: Final = -60.0
QUIET_SONE: Final = 0.1
"""Loudness below which sharpness is not judged."""
_BARK: Final[Array] = np.arange(1, 241) / 10.0
"""Critical-band rates at which sharpness reads the specific loudness, Bark (DIN 45692)."""


def _sharpness_weight(bark: Array) -> Array:
    """Weight of specific loudness in sharpness, z g(z) (DIN 45692, clause 5)."""
    rise = np.maximum(bark - 15.8, 0.0)
    return np.asarray(bark * np.where(rise > 0.0, 0.15 * np.exp(0.42 * rise) + 0.85, 1.0))


@dataclass(frozen=True)
class Loudness:
    """Loudness and sharpness of a sound.

    Attributes
    ----------
    loudness_sone : N, in the field that was asked for; a lower bound where bands are missing
    sharpness_acum : S, a lower bound like N; not a number of a sound that is hardly audible, and
        where missing bands may lower it
    highest_band_hz : nominal midband frequency of the highest third octave that was measured
    """

    loudness_sone: float
    sharpness_acum: float
    highest_band_hz: float = BANDS[-1].nominal_hz

    @property
    def is_lower_bound(self) -> bool:
        """Whether third octaves below 12.5 kHz, or that one, are missing."""
        return self.highest_band_hz < BANDS[-1].nominal_hz

    @property
    def level_phon(self) -> float:
        """Loudness level: 40 + 10 lb N; below 1 sone 40 (N + 0.0005)^0.35 (ISO 532-1, 5.8)."""
        if self.loudness_sone >= 1.0:
            return float(40.0 + 10.0 * np.log2(self.loudness_sone))
        return float(max(40.0 * (self.loudness_sone + 0.0005) ** 0.35, 3.0))


def loudness_of(parts: Sequence[Ingredients], field: SoundField = "free") -> list[Loudness]:
    """Loudness and sharpness of computed sounds.

    Parameters
    ----------
    parts : result of `ingredients`
    field : `free`, from the front, or `diffuse`, as at a listener in a room

    Raises
    ------
    ParameterError
        A third octave below 300 Hz exceeds 120 dB.
    """
    return loudness_of_thirds(np.array([_thirds(part) for part in parts]), field)


def recorded_loudness(bands: NarrowBands) -> Loudness:
    """Loudness and sharpness of a stationary recording.

    The method needs third octaves to 12.5 kHz. At sample rates below 28.3 kHz some are missing:
    both are then lower bounds. Loudness grows with the level of any band. Sound in the missing
    bands adds specific loudness above their lower edge alone, which raises the sharpness where the
    weight at that edge exceeds it.

    Parameters
    ----------
    bands : result of `narrow_bands`

    Raises
    ------
    ParameterError
        See `loudness_of`.
    """
    audible = bands.frequency_hz > 0.0
    square = bands.even_mean_square[audible] @ filter_gain(bands.frequency_hz[audible])
    (loudness,) = loudness_of_thirds(square[None])
    measured = len(measurable_bands(BANDS, 2.0 * float(bands.frequency_hz[-1])))
    if measured == len(BANDS):
        return loudness
    is_bound = loudness.sharpness_acum <= largest_bounded_sharpness(measured)
    return Loudness(
        loudness.loudness_sone,
        loudness.sharpness_acum if is_bound else np.nan,
        BANDS[measured - 1].nominal_hz if measured else 0.0,
    )


def largest_bounded_sharpness(measured: int) -> float:
    """Return the sharpness up to which sound in missing bands raises it, acum.

    Parameters
    ----------
    measured : number of third octaves from 25 Hz that were measured
    """
    return 0.11 * float(_sharpness_weight(np.array(lower_edge_bark(measured))))


def loudness_of_thirds(mean_square: Array, field: SoundField = "free") -> list[Loudness]:
    """Loudness and sharpness from third octaves (ISO 532-1, 5.4 and Annex A).

    Parameters
    ----------
    mean_square : in the bands `CENTRES_HZ`, shape (sound, band), Pa²
    field : sound field, see `loudness_of`
    """
    core = core_loudness(thirds_db(mean_square), field)
    total = total_loudness(core)
    sharp = sharpness(core, total)
    return [Loudness(*pair) for pair in zip(total.tolist(), sharp.tolist(), strict=True)]


def thirds_db(mean_square: Array) -> Array:
    """Return the levels of third octaves, the same shape, dB; silence is -60 dB.

    Parameters
    ----------
    mean_square : any shape, Pa²
    """
    return np.maximum(mean_square_level(mean_square, REFERENCE_PRESSURE_PA), _SILENT_DB)


def sharpness(core: Array, loudness_sone: Array) -> Array:
    """Compute sharpness 0.11 ∫ N' g z dz / N (DIN 45692), acum; not a number below 0.1 sone.

    Parameters
    ----------
    core : core loudness, shape (..., 20), sone/Bark
    loudness_sone : loudness, shape (...), sone
    """
    weighted = 0.1 * specific_loudness(core, _BARK) @ _sharpness_weight(_BARK)
    is_loud = loudness_sone >= QUIET_SONE
    return np.where(is_loud, 0.11 * weighted / np.where(is_loud, loudness_sone, 1.0), np.nan)


def filter_gain(frequency_hz: Array) -> Array:
    """Return the gain of third-octave filters for powers, shape (frequency, band).

    Butterworth's of third order, 1/(1 + ((f/f_m - f_m/f)/b)^6), with b such that white noise comes
    out with the power of its band; a tone near an edge counts in two bands, as it does in a meter.

    Parameters
    ----------
    frequency_hz : frequency above zero, shape (frequency,)
    """
    ratio = frequency_hz[:, None] / CENTRES_HZ
    width = (HALF_BAND - 1.0 / HALF_BAND) * np.sinc(1.0 / 6.0)
    return np.asarray(1.0 / (1.0 + ((ratio - 1.0 / ratio) / width) ** 6))


def _thirds(parts: Ingredients) -> Array:
    """Mean squares in the bands `CENTRES_HZ`, Pa²; noise is even over the logarithm in its band."""
    lines = 0.5 * np.abs(parts.lines.pressure_pa) ** 2 @ filter_gain(parts.lines.frequency_hz)
    gain = noise_gain(tuple(parts.bands.centre_hz.tolist()))
    return np.asarray(lines + parts.bands.pressure_pa**2 @ gain)


@lru_cache(maxsize=16)
def noise_gain(centre_hz: tuple[float, ...]) -> Array:
    """Gain of the filters on noise in third octaves, shape (band, filter)."""
    across = HALF_BAND ** (2.0 * (np.arange(_ACROSS) + 0.5) / _ACROSS - 1.0)
    hertz = np.array(centre_hz)[:, None] * across
    gain = filter_gain(hertz.ravel()).reshape(*hertz.shape, CENTRES_HZ.size)
    return np.asarray(gain.mean(axis=1))
