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
"""What a clear peak stands out of the valleys beside it."""
LEAST_LINES: Final = 3
"""Least number of lines in a band."""


@dataclass(frozen=True)
class Features:
    """Features of all mobilities of a shell.

    Attributes
    ----------
    level_db : in third octaves re 1 m/(N s), mean over all mobilities, shape (band,)
    peak_hz : of the clear peaks of all together, rising, shape (peak,)
    loss_ratio : of each peak
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
    bands = [one for one in np.unique(numbers) if np.sum(numbers == one) >= LEAST_LINES]
    square = np.abs(mobility) ** 2
    levels = [level_of_power(square[:, numbers == one].mean(axis=1)).mean() for one in bands]
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
    before, at, after = level[peak - 1 : peak + 2]
    bend = before - 2.0 * at + after
    offset = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
    step = frequency_hz[peak + 1] - frequency_hz[peak]
    return float(frequency_hz[peak] + np.clip(offset, -0.5, 0.5) * step)


def _half_power(power: Array, frequency_hz: Array, peak: int, step: int) -> float | None:
    """Where the power is half that of the peak, on a straight line; none where it never is."""
    half, at = 0.5 * power[peak], peak
    while 0 <= at + step < power.size and power[at + step] > half:
        at += step
    if not 0 <= at + step < power.size:
        return None
    share = (power[at] - half) / (power[at] - power[at + step])
    return float(frequency_hz[at] + share * (frequency_hz[at + step] - frequency_hz[at]))
