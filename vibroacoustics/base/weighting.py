"""Frequency weightings A, C and Z at the exact frequency, of levels and of signals."""

from collections.abc import Callable
from typing import Final

import numpy as np
from scipy import fft

from .arrays import Array
from .decibel import amplitude_of_level, level_of_amplitude
from .errors import ParameterError

# Pole frequencies of the A and C weightings, Hz (IEC 61672-1:2013, Annex E, from f_r = 1 kHz,
# f_L = 10^1.5 Hz, f_H = 10^3.9 Hz, f_A = 10^2.45 Hz, D = 1/√2).
_F1: Final = 20.598997
_F2: Final = 107.65265
_F3: Final = 737.86223
_F4: Final = 12194.217

_RINGING_S: Final = 0.25
"""Silence after a signal, against its wrapping round: the slowest part, exp(-2π f_1 t), falls to
1e-14. (The kink at half the sample rate leaves 1e-8, of that frequency.)"""


def a_weighting(frequency_hz: Array | float) -> Array:
    """A-weighting in dB at exact frequencies (IEC 61672-1:2013, equation E.6)."""
    return _in_db(_a_gain, frequency_hz)


def c_weighting(frequency_hz: Array | float) -> Array:
    """C-weighting in dB at exact frequencies (IEC 61672-1:2013, equation E.1)."""
    return _in_db(_c_gain, frequency_hz)


def z_weighting(frequency_hz: Array | float) -> Array:
    """Gain of the Z-weighting: 0 dB at every frequency."""
    return np.zeros_like(np.asarray(frequency_hz, dtype=float))


WEIGHTING: Final[dict[str, Callable[[Array | float], Array]]] = {
    "Z": z_weighting,
    "A": a_weighting,
    "C": c_weighting,
}


def check_weighting(weighting: str) -> None:
    """Refuse a weighting that is unknown.

    Raises
    ------
    ParameterError
        It is not in WEIGHTING.
    """
    if weighting not in WEIGHTING:
        raise ParameterError(f"weighting {weighting!r}: must be one of {', '.join(WEIGHTING)}")


def weighted_signal(signal: Array, sample_rate_hz: float, weighting: str) -> Array:
    """Signal with its spectrum weighted, by magnitude only: no phase, no delay.

    The level of every tone is right at its exact frequency up to half the sample rate, where a
    bilinear filter is not. The price is that each sound also rings before it starts, by at most a
    few milliseconds of the size that a meter rings after it. The recording counts as silence
    before its start and after its end, so an offset leaves a click there: skip the first and last
    0.1 s where that matters.

    Parameters
    ----------
    signal : shape (..., time), any unit
    sample_rate_hz : sampling rate of the signal, Hz
    weighting : a key of WEIGHTING

    Returns
    -------
    same shape and unit

    Raises
    ------
    ParameterError
        The weighting is not in WEIGHTING.
    """
    check_weighting(weighting)
    samples = signal.shape[-1]
    length = fft.next_fast_len(samples + int(np.ceil(_RINGING_S * sample_rate_hz)), real=True)
    gain = amplitude_of_level(WEIGHTING[weighting](fft.rfftfreq(length, 1.0 / sample_rate_hz)))
    return np.asarray(fft.irfft(gain * fft.rfft(signal, length), length)[..., :samples])


def _a_gain(frequency: Array) -> Array:
    square = frequency**2
    return np.asarray(_c_gain(frequency) * square / np.sqrt((square + _F2**2) * (square + _F3**2)))


def _c_gain(frequency: Array) -> Array:
    square = frequency**2
    return np.asarray(_F4**2 * square / ((square + _F1**2) * (square + _F4**2)))


def _in_db(gain: Callable[[Array], Array], frequency_hz: Array | float) -> Array:
    """Gain relative to 1 kHz in dB; SILENCE_DB where nothing passes (0 Hz)."""
    relative = gain(np.asarray(frequency_hz, dtype=float)) / gain(np.asarray(1000.0))
    return np.asarray(level_of_amplitude(relative))
