"""Evidence for the speeds of a shaft in the clear lines of a long spectrum."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed
from numpy.typing import NDArray
from scipy import fft
from scipy.ndimage import maximum_filter1d, median_filter

from ..base.arrays import Array

_PADDING: Final = 4
"""Lines of the spectrum to one of a block."""
_MAIN_LOBE: Final = 4
"""Half of the window's, Blackman-Harris, in lines of a block: its side lobes are 92 dB down."""
STEADY_WIDTH: Final = 1.9
"""Width of a steady tone at half of its power, in lines of a block."""
_NOISE_LEVEL: Final = 0.7
"""Mean of ln(1 + p / m) for the power p of white noise with the median m of its mean."""
_CLEAR: Final = 2.3
"""Level of a clear line in a single block: nearly four standard deviations."""
_DYNAMIC_RANGE: Final = 1e-12
_LIKELY: Final = 0.78
"""Probability that the first order of the comb is a clear line."""
_LESS_LIKELY: Final = 0.02
"""Less with each order: of speeds that explain the same lines as lowest orders is the shaft's."""
_LEAST_CHANCE: Final = 5e-3
"""Least chance of a line where a tooth is: the background is never known better."""
_NEIGHBOURHOOD: Final = 0.3
"""Relative distance over which strange lines are counted."""
_TOLERANCE: Final = 1.5e-3
"""Relative distance of a line from its tooth."""
_TOLERANCE_LINES: Final = 0.35
"""Tolerance in lines of a block."""
_BETWEEN: Final = np.array([1.0, 1.5, 2.0]) / 3.0
"""Orders at which no line should be; see `speed_comb`."""


@dataclass(frozen=True)
class Lines:
    """Clear lines of a spectrum.

    Attributes
    ----------
    frequency : rising, in the signal's own frequency, shape (line,)
    level : power over the noise floor, shape (line,)
    width : at half of the power, in lines of a block, shape (line,)
    resolution : frequency between lines of a block
    highest : frequency up to which there may be lines
    spectrum : mean over the blocks of ln(1 + power over floor), at frequencies `step` apart, shape
        (frequency,)
    step : frequency
    """

    frequency: Array
    level: Array
    width: Array
    resolution: float
    highest: float
    spectrum: Array
    step: float

    def density(self) -> Array:
        """Density of lines at least as strong as each one, near it, per unit of frequency."""
        ratio = self.frequency[:, None] / self.frequency
        near = np.abs(np.log(ratio)) < _NEIGHBOURHOOD
        strong = self.level >= self.level[:, None]
        return np.asarray(np.sum(near & strong, axis=1) / (2.0 * _NEIGHBOURHOOD * self.frequency))


def clear_lines(signal: Array, sample_rate: float, length: int, floor_width: float) -> Lines:
    """Clear lines of the mean spectrum of blocks that overlap by half.

    The mean is that of the levels: a line that stands still in all of the blocks stands out, one
    that wanders does not.

    Parameters
    ----------
    signal : shape (sample,)
    sample_rate : sample rate of the signal, in the unit of the wanted frequencies
    length : length of a block, samples
    floor_width : width of the running median that is the noise floor
    """
    starts = np.arange(0, signal.size - length + 1, max(length // 2, 1))
    window = scipy.signal.windows.blackmanharris(length, sym=False)
    blocks = np.array([signal[start : start + length] * window for start in starts])
    power = np.abs(fft.rfft(blocks, _PADDING * length)) ** 2
    step = sample_rate / (_PADDING * length)
    stride = _PADDING // 2
    wide = max(int(floor_width / (step * stride)), 15)
    coarse = median_filter(power[:, ::stride].mean(axis=0), wide, mode="nearest")
    floor = np.interp(np.arange(power.shape[1]), stride * np.arange(coarse.size), coarse)
    floor = np.maximum(floor, _DYNAMIC_RANGE * power.max() + np.finfo(float).tiny)
    level = np.log1p(power / floor).mean(axis=0)
    threshold = _NOISE_LEVEL + _CLEAR / np.sqrt(max(1.0, 0.7 * starts.size))
    top = maximum_filter1d(level, 2 * (_MAIN_LOBE * _PADDING // 2) + 1)
    peaks = np.flatnonzero((level >= top) & (level > threshold))
    peaks = peaks[(peaks > _MAIN_LOBE * _PADDING) & (peaks < level.size - 1)]
    below, mid, right = (level[peaks + offset] for offset in (-1, 0, 1))
    shift = 0.5 * (below - right) / np.minimum(below - 2.0 * mid + right, -1e-9)
    ratio = np.expm1(level)
    width = scipy.signal.peak_widths(ratio, peaks, 0.5)[0] / _PADDING if peaks.size else np.empty(0)
    return Lines(
        frequency=(peaks + shift) * step,
        level=ratio[peaks],
        width=width,
        resolution=sample_rate / length,
        highest=0.5 * sample_rate,
        spectrum=level,
        step=step,
    )


def sharpness(lines: Lines, orders: Array) -> float:
    """Mean over the orders of the highest level at each of them.

    The better an angle follows its shaft, the higher are the lines.

    Parameters
    ----------
    lines : lines of an order spectrum
    orders : orders of the comb, shape (order,)
    """
    covered = orders[orders < lines.highest]
    reach = tolerance(lines, covered)
    first = ((covered - reach) / lines.step).astype(int)
    last = np.minimum(((covered + reach) / lines.step).astype(int) + 1, lines.spectrum.size)
    return float(np.mean([lines.spectrum[a:b].max() for a, b in zip(first, last, strict=True)]))


def evidence(lines: Lines, orders: Array, speeds: Array) -> Array:
    """Log likelihood ratio of speeds, against lines that lie where they do by chance.

    A tooth of the comb at a clear line counts ln(p / q), with p the probability that an order is
    one and q that a strange line as strong lies there, from the density of such lines around; a
    tooth without a line counts ln((1 - p) / (1 - q)). Strong lines do not outweigh many: each tooth
    has the same bounds. Lines between the teeth speak for another shaft.

    Parameters
    ----------
    lines : lines of a spectrum
    orders : orders of the comb, rising, shape (order,)
    speeds : shape (speed,), in the unit of the lines' frequency

    Returns
    -------
    shape (speed,)
    """
    if lines.frequency.size == 0:
        return np.full(speeds.shape, -np.inf)
    below = np.concatenate([[0.0], orders[:-1]])
    between = (below[:, None] + _BETWEEN * (orders - below)[:, None]).ravel()
    for_it = _tooth_evidence(lines, orders, speeds).sum(axis=1)
    against = np.maximum(_tooth_evidence(lines, between, speeds), 0.0).sum(axis=1)
    return np.asarray(for_it - against / _BETWEEN.size)


def tolerance(lines: Lines, frequency: Array) -> Array:
    """Distance within which a line belongs to a tooth."""
    return np.asarray(_TOLERANCE * frequency + _TOLERANCE_LINES * lines.resolution)


def nearest_line(lines: Lines, frequency: Array) -> tuple[Array, Array]:
    """Number of the nearest line and its distance, both of the frequency's shape."""
    right = np.clip(np.searchsorted(lines.frequency, frequency), 1, lines.frequency.size - 1)
    if lines.frequency.size == 1:
        right = np.zeros(frequency.shape, dtype=int)
    below = np.maximum(right - 1, 0)
    is_left = np.abs(lines.frequency[below] - frequency) < np.abs(
        lines.frequency[right] - frequency
    )
    nearest = np.where(is_left, below, right)
    return nearest, lines.frequency[nearest] - frequency


def _tooth_evidence(lines: Lines, orders: Array, speeds: Array) -> Array:
    line_hz = speeds[:, None] * orders
    allowed = tolerance(lines, line_hz)
    nearest, distance = nearest_line(lines, line_hz)
    chance = 1.0 - np.exp(-2.0 * allowed * lines.density()[nearest])
    likely = np.maximum(_LIKELY - _LESS_LIKELY * np.arange(orders.size), 0.5)
    chance = np.clip(chance, _LEAST_CHANCE, 0.9 * likely)
    off = np.abs(distance) / allowed
    hit = np.log(likely / chance) - 0.5 * off**2
    any_line = np.clip(2.0 * allowed * np.sum(lines.frequency > 0) / lines.highest, 0.0, 0.7)
    miss = np.log((1.0 - likely) / (1.0 - any_line))
    covered = line_hz < lines.highest
    return np.where(covered, np.where(off <= 1.5, np.maximum(hit, miss), miss), 0.0)


def best_speeds(
    lines: Lines, orders: Array, lowest: float, highest: float, apart: float
) -> tuple[Array, Array]:
    """Speeds with the most evidence, at least `apart` from each other, and their evidence.

    Parameters
    ----------
    lines, orders : see `evidence`
    lowest, highest : limits of the speed
    apart : relative distance
    """
    trials = np.unique((lines.frequency[:, None] / orders).ravel())
    trials = trials[(trials >= lowest) & (trials <= highest)]
    if trials.size == 0:
        return np.empty(0), np.empty(0)
    trials = _fitted(lines, orders, trials)
    worth = evidence(lines, orders, trials)
    speeds: list[float] = []
    kept: list[float] = []
    for number in np.argsort(-worth):
        if all(abs(np.log(trials[number] / speed)) > apart for speed in speeds):
            speeds.append(float(trials[number]))
            kept.append(float(worth[number]))
        if len(speeds) == 8:
            break
    return np.array(speeds), np.array(kept)


def _fitted(lines: Lines, orders: Array, speeds: Array) -> Array:
    """Speeds that fit the lines near their teeth best (least squares)."""
    line_hz = speeds[:, None] * orders
    distance = nearest_line(lines, line_hz)[1]
    allowed = tolerance(lines, line_hz)
    weight = np.where(np.abs(distance) <= 1.5 * allowed, 1.0 / allowed**2, 0.0)
    change = np.sum(weight * orders * distance, axis=1) / np.sum(weight * orders**2, axis=1)
    return np.asarray(speeds + np.nan_to_num(change))


def are_in_place(lines: Lines, frequency: Array) -> NDArray[np.bool_]:
    """Whether there is a clear line at each frequency, of its shape.

    Parameters
    ----------
    lines : lines of a spectrum
    frequency : frequency in the unit of that of the lines, shape (...)
    """
    if lines.frequency.size == 0:
        return np.zeros(frequency.shape, dtype=bool)
    return np.asarray(np.abs(nearest_line(lines, frequency)[1]) <= tolerance(lines, frequency))


def lines_in_place(lines: Lines, orders: Array) -> tuple[int, int, float]:
    """Orders at which there is a clear line, orders that there can be, mean width of the lines.

    Parameters
    ----------
    lines : lines of an order spectrum
    orders : orders of the comb, shape (order,)

    Returns
    -------
    number of orders in place, number below the highest frequency, width over that of a steady
    tone
    """
    covered = orders[orders < lines.highest]
    if lines.frequency.size == 0:
        return 0, covered.size, np.nan
    nearest = nearest_line(lines, covered)[0]
    near = are_in_place(lines, covered)
    width = np.nan
    if near.any():  # a speed that is not followed widens the high orders most
        width = np.average(lines.width[nearest[near]], weights=covered[near]) / STEADY_WIDTH
    return int(np.count_nonzero(near)), covered.size, float(width)
