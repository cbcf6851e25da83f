"""Features of mobilities in which shells differ, and a sample's agreement with hammer tests."""

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


MOST_DEVIATIONS: Final = 4.0
"""A peak that lies further off counts as this many tolerances, as one that is not there."""
LARGEST_MISFIT: Final = 1000.0
"""Bound that keeps a likelihood above zero, so that weights without it can be computed."""


@dataclass(frozen=True)
class Tolerances:
    """Standard deviations of what is compared: of the model more than of the test.

    Attributes
    ----------
    gain_db : tolerance of the mean level of mobilities in a third octave, dB
    frequency_ratio : tolerance of a natural frequency, as a ratio
    loss_ratio : tolerance of a loss factor, as a ratio
    """

    gain_db: float
    frequency_ratio: float
    loss_ratio: float


@dataclass(frozen=True)
class ShellAgreement:
    """A sample beside the test.

    Attributes
    ----------
    likelihood : from 0 to 1
    gain_db : mean level over that measured
    frequency_ratio : median of the natural frequencies over those measured
    loss_ratio : median of the loss factors over those measured; not a number without a peak
    """

    likelihood: float
    gain_db: float
    frequency_ratio: float
    loss_ratio: float


def shell_agreement(
    measured: Features, sampled: Features, tolerances: Tolerances
) -> ShellAgreement:
    """Likelihood exp(-(a + b + c)/2) of mean squared deviations in tolerances.

    a of the levels of all bands, b of the natural frequencies, each against the
    nearest clear peak of the sample, c of the loss factors of the peaks that so meet. The mean, not
    the sum: what a model of one shell makes wrong is alike in all its bands and peaks, so that each
    of the three counts as one measurement however many lines there are (composite likelihood:
    Varin, Reid and Firth 2011, Statistica Sinica 21, 5, section 2.3).

    Parameters
    ----------
    measured, sampled : features of the same mobilities at the same lines
    tolerances : tolerances of each kind of feature
    """
    levels = sampled.level_db - measured.level_db
    misfit = float(np.mean((levels / tolerances.gain_db) ** 2))
    frequency, loss = _of_peaks(measured, sampled)
    if measured.peak_hz.size:
        off = np.log(frequency) / np.log1p(tolerances.frequency_ratio)
        misfit += float(np.mean(np.minimum(np.abs(off), MOST_DEVIATIONS) ** 2))
        meets = np.abs(off) < MOST_DEVIATIONS
        lossy = np.log(loss) / np.log1p(tolerances.loss_ratio)
        misfit += float(np.mean(lossy[meets] ** 2)) if np.any(meets) else MOST_DEVIATIONS**2
    return ShellAgreement(
        float(np.exp(-0.5 * min(misfit, LARGEST_MISFIT))),
        float(levels.mean()),
        float(np.median(frequency)) if frequency.size else float("nan"),
        float(np.median(loss)) if loss.size else float("nan"),
    )


def _of_peaks(measured: Features, sampled: Features) -> tuple[Array, Array]:
    """Natural frequency and loss factor of the nearest peak over those measured, each (peak,)."""
    if not sampled.peak_hz.size:
        nothing = np.full(measured.peak_hz.size, np.inf)
        return nothing, np.ones_like(nothing)
    ratio = sampled.peak_hz / measured.peak_hz[:, None]
    nearest = np.argmin(np.abs(np.log(ratio)), axis=1)
    rows = np.arange(len(ratio))
    return ratio[rows, nearest], sampled.loss_ratio[nearest] / measured.loss_ratio
