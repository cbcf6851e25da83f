"""Computed sound as a spectrum whose tones `tones` judges one by one, as the standard does."""

import numpy as np

from vibroacoustics.levels.bands import HALF_BAND
from vibroacoustics.sound.ingredients import Ingredients
from vibroacoustics.sound.tonality import TonalSpectrum


def tonal_spectrum(parts: Ingredients) -> TonalSpectrum:
    """Lines and bands of a computed sound; in a band noise is even over the logarithm.

    Parameters
    ----------
    parts : result of `ingredients`
    """
    square = parts.bands.pressure_pa**2
    lower, upper = (parts.bands.centre_hz * edge for edge in (1.0 / HALF_BAND, HALF_BAND))

    def noise(first: float, last: float) -> float:
        inner = np.log(np.minimum(upper, last) / np.maximum(lower, first))
        return float(square @ np.clip(inner, 0.0, None) / (2.0 * np.log(HALF_BAND)))

    lines = parts.lines
    squares = 0.5 * np.abs(lines.pressure_pa) ** 2
    steady = np.ones_like(squares), np.zeros_like(squares)
    return TonalSpectrum(lines.frequency_hz, squares, noise, lines.name, *steady)
