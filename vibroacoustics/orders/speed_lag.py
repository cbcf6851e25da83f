"""Lag of a speed behind the sound: where the lines that it predicts are beside those of the signal.

Where a recorded speed f is late by τ, an order k is at k f(t + τ)/f(t) of the recorded shaft: it is
no straight line of the order map. The lag that straightens the lines is found first; the positions
of the lines in every block then give it and its error by regression on f'/f.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.ndimage import median_filter

from ..base.arrays import Array
from .crank_motion import CrankMotion

HIGHEST_ORDER: Final = 20.0
LEAST_LAG_S: Final = 0.01
"""Least lag that counts: sound takes 3 ms over a metre."""
_LOWEST_ORDER: Final = 0.3
_REVOLUTIONS: Final = 16
"""Revolutions of a block: lines are 1/8 order wide."""
_PER_REVOLUTION: Final = 50
_HOPS: Final = 4
"""Blocks start every quarter of their length."""
_MOST_BLOCKS: Final = 400
_LEAST_BLOCKS: Final = 12
_LONGEST_S: Final = 1.0
_STEPS: Final = 21
"""Trial lags."""
_MOST_LINES: Final = 6
_REACH_ORDER: Final = 0.25
"""Distance from the mean of a line within which it is looked for in every block."""
_CLEAR_MEAN: Final = 1.0
_CLEAR: Final = 3.0
"""Level of a line, ln of power over floor: of the mean, and of a block (13 dB)."""
_LEAST_SHARE: Final = 0.5
"""Share of the blocks in which a line is clear."""
_ROUNDS: Final = 3
_ITERATIONS: Final = 10
_HUBER: Final = 1.5
_LEAST_SCATTER: Final = 2e-4
"""Relative error of the position of a line by a parabola."""
_SHARPER: Final = 1.05
"""Gain of sharpness from which a trial lag is better than none."""
_AGREEMENT: Final = 0.25
"""Largest difference of the lines' departures, of their mean."""
_FLOOR_LINES: Final = 65


@dataclass(frozen=True)
class SpeedLag:
    """Lag of a speed behind the sound.

    Attributes
    ----------
    lag_s : above zero where the speed is late
    error_s : standard error; infinite where the lines fix no lag, which then is 0
    bend : change of the orders that the lag explains, over the scatter of the lines, RMS
    lines : orders of the lines that it comes from, shape (line,)
    unmoved_lines : orders of clear lines without the lag, shape (line,)
    slope_per_s : median of f'/f
    slope_scatter : median deviation of f'/f from it
    time_s : mid-time of each block, shape (block,)
    departure : speed of the sound over that of the shaft less 1, lag aside, shape (block,); 0 where
        fewer than two lines agree on it
    scatter : standard deviation of the departure of the widest line
    """

    lag_s: float
    error_s: float
    bend: float
    lines: Array
    unmoved_lines: Array
    slope_per_s: float
    slope_scatter: float
    time_s: Array
    departure: Array
    scatter: float

    @property
    def is_sure(self) -> bool:
        """Whether the lines fix the lag better than the least one that counts."""
        return self.error_s < 0.5 * LEAST_LAG_S


@dataclass(frozen=True)
class _Blocks:
    """Levels of order spectra over a floor, ln(1 + p), and times of the blocks.

    Attributes
    ----------
    level : shape (block, line)
    step : order between lines
    start_s, middle_s, end_s : times of the blocks, shape (block,)
    """

    level: Array
    step: float
    start_s: Array
    middle_s: Array
    end_s: Array


def speed_lag(
    signal: Array, sample_rate_hz: float, motion: CrankMotion
) -> tuple[SpeedLag | None, float]:
    """Lag of a motion behind the orders in a signal, and how clear their lines are.

    Parameters
    ----------
    signal : shape (time,), any unit
    sample_rate_hz : sample rate of the signal
    motion : motion of the shaft, whose speed varies

    Returns
    -------
    lag, None where too few blocks have a clear line; sharpness of the lines
    """
    blocks = _order_blocks(signal, sample_rate_hz, motion)
    if blocks is None:
        return None, 0.0
    unmoved = _regression(blocks, motion)
    if unmoved is not None and abs(unmoved.lag_s) < LEAST_LAG_S and unmoved.is_sure:
        return replace(unmoved, bend=abs(unmoved.lag_s) * unmoved.bend), np.inf
    trials = np.linspace(-_LONGEST_S, _LONGEST_S, _STEPS)
    sharpness = [_sharpness(blocks, _shift(motion, blocks.middle_s, trial)) for trial in trials]
    first = _sharpness(blocks, np.ones(blocks.middle_s.size))
    best = int(np.argmax(sharpness))
    lag_s = float(trials[best]) if sharpness[best] > _SHARPER * first else 0.0
    latest = _followed(signal, sample_rate_hz, motion, lag_s)
    if latest is not None:
        shift = _shift(motion, blocks.middle_s, latest.lag_s)
        latest = None if _sharpness(blocks, shift) < first / _SHARPER else latest
    if latest is None:
        without = None if unmoved is None else replace(unmoved, lag_s=0.0, bend=0.0, error_s=np.inf)
        return without, max(sharpness)
    lines = np.empty(0) if unmoved is None else unmoved.lines
    return replace(latest, unmoved_lines=lines), max(sharpness)


def _followed(
    signal: Array, sample_rate_hz: float, motion: CrankMotion, lag_s: float
) -> SpeedLag | None:
    """Lag of a motion from a trial lag on; None where it does not converge."""
    latest = None
    for _ in range(_ROUNDS):
        shifted = late(motion, lag_s)
        blocks = None if shifted is None else _order_blocks(signal, sample_rate_hz, shifted)
        latest = None if blocks is None or shifted is None else _regression(blocks, shifted)
        if latest is None or abs(lag_s + latest.lag_s) > 2.0 * _LONGEST_S:
            return None
        lag_s += latest.lag_s
    return None if latest is None else replace(latest, lag_s=lag_s, bend=abs(lag_s) * latest.bend)


def late(motion: CrankMotion, lag_s: float) -> CrankMotion | None:
    """Motion of a shaft whose recorded motion is late; None where nothing is left of it.

    Parameters
    ----------
    motion : recorded motion
    lag_s : its lag
    """
    if abs(lag_s) >= motion.end_s - motion.start_s:
        return None
    return motion.delayed(-lag_s)


def _order_blocks(signal: Array, rate_hz: float, motion: CrankMotion) -> _Blocks | None:
    """Order spectra of blocks that overlap; None of too few."""
    first = max(int(np.ceil(motion.start_s * rate_hz)), 0)
    last = min(int(motion.end_s * rate_hz) + 1, signal.size)
    if last - first < _PER_REVOLUTION:
        return None
    time_s = np.arange(first, last) / rate_hz
    turned = motion.angle_rad(time_s) / (2.0 * np.pi)
    grid = np.arange(turned[0], turned[-1], 1.0 / _PER_REVOLUTION)
    length = _REVOLUTIONS * _PER_REVOLUTION
    count = (grid.size - length) // (length // _HOPS) + 1
    if count < _LEAST_BLOCKS:
        return None
    starts = np.linspace(0, grid.size - length, min(count, _MOST_BLOCKS)).astype(int)
    samples = np.interp(grid, turned, signal[first:last])
    grid_s = np.interp(grid, turned, time_s)
    window = np.hanning(length + 1)[:-1]
    spectra = fft.rfft(samples[starts[:, None] + np.arange(length)] * window, 2 * length)
    power = spectra.real**2 + spectra.imag**2
    floor = median_filter(power.mean(axis=0), _FLOOR_LINES, mode="nearest")
    level = np.log1p(power / np.maximum(floor, 1e-12 * power.max() + np.finfo(float).tiny))
    middle, end = grid_s[starts + length // 2], grid_s[starts + length - 1]
    return _Blocks(level, 0.5 / _REVOLUTIONS, grid_s[starts], middle, end)


def _shift(motion: CrankMotion, time_s: Array, lag_s: float) -> Array:
    """Speed of the shaft over that of a motion that is late, shape (block,)."""
    later = np.clip(time_s + lag_s, motion.start_s, motion.end_s)
    return np.asarray(motion.frequency_hz(later) / motion.frequency_hz(time_s))


def _sharpness(blocks: _Blocks, shift: Array) -> float:
    """Sum of the third powers of the mean levels, each block's orders shifted by a factor."""
    order = np.arange(_LOWEST_ORDER, HIGHEST_ORDER, blocks.step)
    position = order * shift[:, None] / blocks.step
    below = np.minimum(position.astype(int), blocks.level.shape[1] - 2)
    row = np.arange(shift.size)[:, None]
    above = position - below
    level = blocks.level[row, below] * (1.0 - above) + blocks.level[row, below + 1] * above
    mean = level.mean(axis=0)
    return float(np.sum(np.maximum(mean - np.median(mean), 0.0) ** 3))


def _lines(blocks: _Blocks) -> list[tuple[float, Array, NDArray[np.bool_]]]:
    """Clear lines: mean order, change of its logarithm by block, whether the block is clear."""
    mean = blocks.level.mean(axis=0)
    half = round(_REACH_ORDER / blocks.step)
    lowest, highest = (round(order / blocks.step) for order in (_LOWEST_ORDER, HIGHEST_ORDER))
    threshold = float(np.median(mean)) + _CLEAR_MEAN
    chosen: list[int] = []
    for line in np.argsort(-mean).tolist():
        if mean[line] < threshold or len(chosen) == _MOST_LINES:
            break
        is_within = max(lowest, half + 1) <= line < min(highest, mean.size - half - 1)
        if is_within and all(abs(line - other) > 2 * half for other in chosen):
            chosen.append(line)
    lines = []
    for line in chosen:
        position, is_clear = _peaks(blocks.level[:, line - half : line + half + 1])
        if np.mean(is_clear) >= _LEAST_SHARE:
            order = (line - half + position) * blocks.step
            middle = float(np.median(order[is_clear]))
            lines.append((middle, np.log(order / middle), is_clear))
    return lines


def _peaks(level: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Position of the highest level of each row by a parabola, and whether it is a clear peak."""
    top = level.argmax(axis=1)
    inner = np.clip(top, 1, level.shape[1] - 2)
    row = np.arange(top.size)
    below, middle, above = (level[row, inner + offset] for offset in (-1, 0, 1))
    shift = 0.5 * (below - above) / np.minimum(below - 2.0 * middle + above, -1e-9)
    return inner + np.clip(shift, -0.5, 0.5), (top == inner) & (middle > _CLEAR)


def _regression(blocks: _Blocks, motion: CrankMotion) -> SpeedLag | None:
    """Lag of a motion that is nearly right, from the positions of the lines over f'/f."""
    lines = _lines(blocks)
    if not lines:
        return None
    ends = (np.clip(each, motion.start_s, motion.end_s) for each in (blocks.start_s, blocks.end_s))
    start_hz, end_hz = (motion.frequency_hz(each) for each in ends)
    slope = np.log(end_hz / start_hz) / (blocks.end_s - blocks.start_s)
    change = np.array([each for _, each, _ in lines])
    is_clear = np.array([each for *_, each in lines])
    scatter: Array = np.ones((len(lines), 1))
    weight: Array = is_clear.astype(float)
    for _ in range(_ITERATIONS):
        total = weight.sum(axis=1, keepdims=True)
        slopes = slope - (weight * slope).sum(axis=1, keepdims=True) / total
        changes = change - (weight * change).sum(axis=1, keepdims=True) / total
        square = float((weight * slopes**2).sum()) + 1e-30
        lag_s = float((weight * slopes * changes).sum()) / square
        residual = changes - lag_s * slopes
        scatter = 1.4826 * _medians(np.abs(residual), is_clear) + _LEAST_SCATTER
        weight = is_clear / np.maximum(np.abs(residual) / (_HUBER * scatter), 1.0) / scatter**2
    orders = np.array([order for order, *_ in lines])
    departure = _common_departure(np.where(is_clear, residual, np.nan))
    return SpeedLag(
        lag_s=lag_s,
        error_s=float(np.sqrt(_HOPS / square)),  # of blocks that overlap
        bend=float(np.sqrt(square / np.count_nonzero(is_clear))),  # by 1 s
        lines=orders,
        unmoved_lines=orders,
        slope_per_s=float(np.median(slope)),
        slope_scatter=float(np.median(np.abs(slope - np.median(slope)))),
        time_s=blocks.middle_s,
        departure=departure,
        scatter=float(scatter.max()),
    )


def _medians(values: Array, is_clear: NDArray[np.bool_]) -> Array:
    """Median of each row over its clear blocks, shape (line, 1)."""
    return np.array([[np.median(row[clear])] for row, clear in zip(values, is_clear, strict=True)])


def _common_departure(departure: Array) -> Array:
    """Departure on which the lines agree, shape (block,), 0 where fewer than two do.

    Parameters
    ----------
    departure : departure of each line, not a number where it is not clear, shape (line, block)
    """
    count = np.count_nonzero(np.isfinite(departure), axis=0)
    filled = np.where(np.isfinite(departure), departure, 0.0)
    mean = filled.sum(axis=0) / np.maximum(count, 1)
    largest = np.nanmax(np.abs(np.where(count > 0, departure, 0.0) - mean), axis=0)
    return np.where((count >= 2) & (largest < _AGREEMENT * np.abs(mean)), mean, 0.0)
