"""Features of mobilities in which shells differ: level by band, clear peaks and their loss factors.

Levels of neighbouring lines go up and down together, so that lines are no measurements of their
own. Measured and computed mobilities are taken by the same steps at the same lines: what these
steps make wrong, such as a loss factor of a peak that is narrower than a line, is alike in both.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.signal import find_peaks

from ..base.arrays import Array, ComplexArray
from ..base.decibel import level_of_power
from ..mechanics.added import third_octave_number

CLEAR_DB: Final = 6.0
"""Height of a clear peak above the valleys beside it."""
LEAST_LINES: Final = 3
"""Least number of lines in a band."""


@dataclass(frozen=True)
class Features:
    """Features of all mobilities of a shell.

    Attributes
    ----------
    level_db : in third octaves re 1 m/(N s), mean over all mobilities, shape (band,)
    peak_hz : frequencies of the clear peaks of all together, rising, shape (peak,)
    loss_ratio : loss factor of each peak, shape (peak,)
    """

    level_db: Array
    peak_hz: Array
    loss_ratio: Array


def features(mobility: ComplexArray, frequency_hz: Array) -> Features:
    """Features of mobilities.

    Parameters
    ----------
    mobility : m/(N s), shape (mobility, frequency)
    frequency_hz : rising, above zero, shape (frequency,)
    """
    numbers = third_octave_number(frequency_hz)
    bands = [band for band in np.unique(numbers) if np.sum(numbers == band) >= LEAST_LINES]
    square = np.abs(mobility) ** 2
    levels = [level_of_power(square[:, numbers == band].mean(axis=1)).mean() for band in bands]
    peak_hz, loss = clear_peaks(square.sum(axis=0), frequency_hz)
    return Features(np.array(levels), peak_hz, loss)


def clear_peaks(power: Array, frequency_hz: Array) -> tuple[Array, Array]:
    """Frequencies and loss factors of the peaks that stand out by `CLEAR_DB`, each (peak,).

    The frequency by a parabola through the level of three lines, the loss factor by the width
    at half power, (f₂² - f₁²) / (2 f²) of structural damping (ISO 7626-1:2011, annex; Ewins, Modal
    Testing, 2000, section 4.2.1).

    Parameters
    ----------
    power : sum of squares, above zero, shape (frequency,)
    frequency_hz : shape (frequency,)
    """
    level = level_of_power(power)
    peaks, _ = find_peaks(level, prominence=CLEAR_DB)
    frequencies, losses = [], []
    for peak in peaks:
        low = _half_power(power, frequency_hz, int(peak), -1)
        high = _half_power(power, frequency_hz, int(peak), 1)
        if low is not None and high is not None:
            middle = _top(level, frequency_hz, int(peak))
            frequencies.append(middle)
            losses.append((high**2 - low**2) / (2.0 * middle**2))
    return np.array(frequencies), np.array(losses)


def _top(level: Array, frequency_hz: Array, peak: int) -> float:
    """Return the top of the parabola through a peak and the lines beside it."""
    before, middle, after = level[peak - 1 : peak + 2]
    bend = before - 2.0 * middle + after
    offset = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
    step = frequency_hz[peak + 1] - frequency_hz[peak]
    return float(frequency_hz[peak] + np.clip(offset, -0.5, 0.5) * step)


def _half_power(power: Array, frequency_hz: Array, peak: int, step: int) -> float | None:
    """Frequency of half the peak's power, on a straight line; none where it never is."""
    half, line = 0.5 * power[peak], peak
    while 0 <= line + step < power.size and power[line + step] > half:
        line += step
    if not 0 <= line + step < power.size:
        return None
    share = (power[line] - half) / (power[line] - power[line + step])
    return float(frequency_hz[line] + share * (frequency_hz[line + step] - frequency_hz[line]))
