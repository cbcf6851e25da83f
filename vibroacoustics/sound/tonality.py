"""Discrete tones: tone-to-noise ratio and prominence ratio (ECMA-418-1)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.constants import LOWEST_PROMINENT_TONE_HZ, REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, mean_square_level
from ..levels.hearing import hearing_threshold_db
from .critical_bands import (
    CUT_BELOW_HZ,
    HIGHEST_TONE_HZ,
    Edges,
    band_above,
    band_below,
    critical_band,
    noise_criterion_db,
    prominence_criterion_db,
)
from .prominence import belonging, strongest


@dataclass(frozen=True)
class TonalSpectrum:
    """Tones and the noise between them.

    Attributes
    ----------
    frequency_hz, mean_square : frequency and mean square of the tones, shape (tone,), Pa²
    noise : mean square of the noise between two frequencies, without the tones, Pa²
    name : name of the tones
    share, swing_db : share of the time that each tone sounds, and how its level swings meanwhile,
        shape (tone,)
    """

    frequency_hz: Array
    mean_square: Array
    noise: Callable[[float, float], float]
    name: tuple[str, ...]
    share: Array
    swing_db: Array

    def of_tones(self, band: Edges) -> float:
        """Mean square of all tones in a band, Pa²."""
        within = (self.frequency_hz >= band.lower) & (self.frequency_hz < band.upper)
        return float(self.mean_square[within].sum())

    def total(self, band: Edges) -> float:
        """Mean square in a band, Pa²."""
        return self.of_tones(band) + self.noise(*band)


@dataclass(frozen=True)
class Tone:
    """A discrete tone.

    Attributes
    ----------
    name, frequency_hz : name and frequency of the strongest line
    level_db : with the weaker lines that belong to it, dB re 20 µPa
    noise_ratio_db : tone-to-noise ratio; infinite without noise
    prominence_db : prominence ratio; infinite without sound in the neighbouring bands
    share : share of the time that the strongest line sounds; the levels are those meanwhile
    swing_db : level of the strongest line exceeded for 10 % of that time over that for 90 %
    """

    name: str
    frequency_hz: float
    level_db: float
    noise_ratio_db: float
    prominence_db: float
    share: float = 1.0
    swing_db: float = 0.0

    @property
    def audible(self) -> bool:
        """Whether its level reaches the threshold of hearing."""
        return self.level_db >= hearing_threshold_db(self.frequency_hz)

    @property
    def prominent_by_noise(self) -> bool:
        """Whether it is prominent by its tone-to-noise ratio."""
        return self.audible and self.noise_ratio_db >= noise_criterion_db(self.frequency_hz)

    @property
    def prominent_by_bands(self) -> bool:
        """Whether it is prominent by its prominence ratio."""
        return self.audible and self.prominence_db >= prominence_criterion_db(self.frequency_hz)

    @property
    def prominent(self) -> bool:
        """Whether it is so by one of the two; the standard takes either."""
        return self.prominent_by_noise or self.prominent_by_bands


def tone_to_noise_db(tone: float, noise: float) -> float:
    """ΔL_T = 10 lg(W_T / W_N), dB, of the mean squares of tone and noise in its critical band."""
    return _ratio_db(tone, noise)


def prominence_ratio_db(middle: float, below: float, above: float) -> float:
    """ΔL_P = 10 lg(W_M / ((W_L + W_U) / 2)), dB, of critical bands about, below and above a tone.

    Parameters
    ----------
    middle, below, above : mean squares; that of a band cut at 20 Hz by 100 Hz over its width
    """
    return _ratio_db(middle, 0.5 * (below + above))


def _ratio_db(power: float, other: float) -> float:
    return float(level_of_power(power / other)) if other > 0.0 else float("inf")


def tones(spectrum: TonalSpectrum) -> list[Tone]:
    """Discrete tones between 89.1 Hz and 11.22 kHz, the strongest first.

    Weaker lines near a stronger one in its critical band belong to it (`proximity_hz`). The noise
    of a critical band is without all of its tones, also those that do not belong to it.

    Parameters
    ----------
    spectrum : result of `recorded_spectrum`
    """
    hertz = spectrum.frequency_hz
    judged = np.flatnonzero((hertz >= LOWEST_PROMINENT_TONE_HZ) & (hertz <= HIGHEST_TONE_HZ))
    square = spectrum.mean_square[judged]
    (together,) = strongest(square[None], belonging(hertz[judged]))
    loudest_first = np.argsort(-square, kind="stable")
    return [
        _judged(spectrum, int(judged[number]), float(together[number]))
        for number in loudest_first
        if together[number] > 0.0
    ]


def prominent(judged: Sequence[Tone]) -> list[Tone]:
    """Those of the tones that are prominent."""
    return [tone for tone in judged if tone.prominent]


def _judged(spectrum: TonalSpectrum, number: int, square: float) -> Tone:
    hertz = float(spectrum.frequency_hz[number])
    middle, below, above = critical_band(hertz), band_below(hertz), band_above(hertz)
    cut = 100.0 / below.width if hertz <= CUT_BELOW_HZ else 1.0
    sums = spectrum.total(middle), cut * spectrum.total(below), spectrum.total(above)
    return Tone(
        spectrum.name[number],
        hertz,
        float(mean_square_level(square, REFERENCE_PRESSURE_PA)),
        tone_to_noise_db(square, spectrum.noise(*middle)),
        prominence_ratio_db(*sums),
        float(spectrum.share[number]),
        float(spectrum.swing_db[number]),
    )
