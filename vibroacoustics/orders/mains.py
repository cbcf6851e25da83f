"""Lines of the mains in a signal, and the signal without them."""

from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array

_DEVIATION: Final = 0.004
"""Largest deviation of the mains frequency from its nominal value, relative: 0.2 Hz in 50 Hz."""
_NOMINAL_HZ: Final = (50.0, 60.0, 100.0, 120.0)
"""Lowest lines of hum: the mains frequency and twice that."""
_AS_EVEN: Final = 0.002
"""Largest relative deviation of a speed from a line of hum at which it may be that line."""
_TRIALS: Final = 401
_HALF_WIDTH_LINES: Final = 2.5
"""Lines of the transform that a steady line fills to each side, with a Hann window."""
_DRIFT: Final = 2e-4
"""Drift of the mains frequency within a recording, relative."""


def without_mains(signal: Array, sample_rate_hz: float, nominal_hz: float) -> Array:
    """The signal without lines at multiples of the mains frequency.

    The frequency is looked for within 0.4 % of its nominal value; the lines around its multiples
    are scaled down to the median of those beside them. Orders of a shaft that turn just as fast are
    lost with them; those that only cross in a run-up hardly change.

    Parameters
    ----------
    signal : shape (time,)
    sample_rate_hz : sample rate of the signal
    nominal_hz : nominal frequency of the mains, 50 or 60
    """
    spectrum = fft.rfft(signal)
    line_hz = sample_rate_hz / signal.size
    actual = mains_frequency_hz(signal, sample_rate_hz, nominal_hz)
    power = np.abs(spectrum)
    for multiple in range(1, int(0.5 * sample_rate_hz / actual) + 1):
        middle = multiple * actual / line_hz
        half = _HALF_WIDTH_LINES + _DRIFT * middle
        near = slice(int(np.ceil(middle - half)), int(middle + half) + 1)
        around = slice(max(int(middle - 8.0 * half), 0), int(middle + 8.0 * half) + 1)
        level = np.median(power[around])
        spectrum[near] *= np.minimum(1.0, level / np.maximum(power[near], 1e-300))
    return np.asarray(fft.irfft(spectrum, signal.size))


def mains_of(speed_hz: Array) -> float | None:
    """Nominal line of hum near which a speed is at all times, Hz; None for any other speed.

    Parameters
    ----------
    speed_hz : speed over the time, shape (time,)
    """
    for nominal in _NOMINAL_HZ:
        if np.all(np.abs(speed_hz / nominal - 1.0) < _AS_EVEN):
            return nominal
    return None


def mains_frequency_hz(signal: Array, sample_rate_hz: float, nominal_hz: float) -> float:
    """Frequency near the nominal one whose multiples hold the clearest lines.

    Parameters
    ----------
    signal, sample_rate_hz, nominal_hz : see `without_mains`
    """
    window = np.hanning(signal.size)
    level = np.log(np.abs(fft.rfft(window * signal)) + 1e-300)
    trials = nominal_hz * np.linspace(1.0 - _DEVIATION, 1.0 + _DEVIATION, _TRIALS)
    multiple = np.arange(1, max(int(0.5 * sample_rate_hz / trials[-1]), 1) + 1)
    bins = np.outer(trials, multiple) * signal.size / sample_rate_hz
    covered = bins < level.size - 1
    values = np.where(covered, np.interp(bins, np.arange(level.size), level), 0.0)
    # The clearest few: most multiples hold nothing.
    clearest = np.sort(values - np.median(values, axis=0), axis=1)[:, -6:]
    return float(trials[np.argmax(clearest.sum(axis=1))])
