"""Critical bands and criteria of discrete tones (ECMA-418-1)."""

from typing import Any, Final, NamedTuple, TypeVar, cast

import numpy as np

from ..base.arrays import Array

Frequency = TypeVar("Frequency", float, Array)

HIGHEST_TONE_HZ: Final = 11220.0
"""Highest tone that is judged: upper edge of the third octave of 10 kHz (ECMA-418-1, clause 1)."""
CUT_BELOW_HZ: Final = 171.4
"""Frequency below which the critical band underneath a tone is cut at 20 Hz."""
_LOWER: Final = ((171.4, 20.0, 0.0, 0.0), (1600.0, -149.5, 1.001, -6.9e-5))
_LOWER_ABOVE: Final = (6.8, 0.806, -8.2e-6)
_UPPER_TO_1600: Final = (149.5, 1.035, 7.7e-5)
_UPPER_ABOVE: Final = (3.3, 1.215, 2.16e-5)


class Edges(NamedTuple):
    """Lower and upper edge of a band, Hz."""

    lower: float
    upper: float

    @property
    def width(self) -> float:
        """Hz."""
        return self.upper - self.lower


def critical_bandwidth(frequency_hz: Frequency) -> Frequency:
    """Δf_c = 25 + 75 (1 + 1.4 (f/kHz)²)^0.69, Hz (ECMA-418-1; ISO/PAS 20065, equation 2)."""
    square = (cast(Any, frequency_hz) / 1000.0) ** 2
    return cast(Frequency, 25.0 + 75.0 * (1.0 + 1.4 * square) ** 0.69)


def critical_band(frequency_hz: float) -> Edges:
    """Band about a tone: up to 500 Hz the tone is its middle, above its geometric mean."""
    width = critical_bandwidth(frequency_hz)
    if frequency_hz <= 500.0:
        return Edges(frequency_hz - 0.5 * width, frequency_hz + 0.5 * width)
    lower = 0.5 * (np.sqrt(width**2 + 4.0 * frequency_hz**2) - width)
    return Edges(float(lower), float(lower + width))


def band_below(frequency_hz: float) -> Edges:
    """Critical band next below that of a tone; f_1 = C0 + C1 f + C2 f²."""
    upper = critical_band(frequency_hz).lower
    for highest, *constants in _LOWER:
        if frequency_hz <= highest:
            return Edges(_quadratic(constants, frequency_hz), upper)
    return Edges(_quadratic(_LOWER_ABOVE, frequency_hz), upper)


def band_above(frequency_hz: float) -> Edges:
    """Critical band next above that of a tone; f_2 = C0 + C1 f + C2 f²."""
    constants = _UPPER_TO_1600 if frequency_hz <= 1600.0 else _UPPER_ABOVE
    return Edges(critical_band(frequency_hz).upper, _quadratic(constants, frequency_hz))


def _quadratic(constants: tuple[float, ...] | list[float], value: float) -> float:
    return constants[0] + constants[1] * value + constants[2] * value**2


def proximity_hz(frequency_hz: Frequency) -> Frequency:
    """Within it a weaker tone belongs to a stronger one: 21 · 10^(1.2 |lg(f/212)|^1.8), Hz.

    It is equation 19 of ISO/PAS 20065, too.

    From 1 kHz on it is more than half of the critical band: all tones in it belong together.
    """
    exponent = 1.2 * np.abs(np.log10(cast(Any, frequency_hz) / 212.0)) ** 1.8
    return cast(Frequency, 21.0 * 10.0**exponent)


def noise_criterion_db(frequency_hz: float) -> float:
    """Tone-to-noise ratio from which a tone is prominent: 8 + 8.33 lg(1000/f), 8 from 1 kHz, dB."""
    return 8.0 + 8.33 * max(float(np.log10(1000.0 / frequency_hz)), 0.0)


def prominence_criterion_db(frequency_hz: float) -> float:
    """Prominence ratio from which a tone is prominent: 9 + 10 lg(1000/f), 9 from 1 kHz, dB."""
    return 9.0 + 10.0 * max(float(np.log10(1000.0 / frequency_hz)), 0.0)
