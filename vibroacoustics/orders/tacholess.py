"""Crank motion from the signal itself, where no speed was recorded."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numba
import numpy as np
import scipy  # loads its subpackages when they are needed
from numpy.typing import NDArray
from scipy.fft import next_fast_len
from scipy.interpolate import PPoly

from ..base.arrays import Array
from ..base.errors import ParameterError
from .crank_motion import CrankMotion, from_curve
from .smoothing import smooth_curve
from .speed_comb import comb_scores, frame_levels, refine

_REVOLUTIONS: Final = 8
"""In a frame at the lowest speed: the lines of its orders lie four Hann half-widths apart."""
_FRAMES_PER_LENGTH: Final = 4
_LEAST_FRAMES: Final = 9
"""Three frame lengths."""
_GRID: Final = 0.002
"""Ratio between neighbouring candidates, less one. The peak of the tenth order is 1 % wide or more
up to six times the lowest speed."""
_OVERSAMPLING: Final = 4
"""Samples per period of the highest order: the frames are straightened by linear interpolation."""
_BOUND_COST: Final = 4.0
"""Of a change of speed at the bound, in units of ln likelihood: a line 17 dB above the noise."""
_OFF_PATH: Final = 0.05
"""Relative distance from which a speed counts as another one."""


@dataclass(frozen=True)
class TacholessResult:
    """Crank motion from a signal, with how sure it is."""

    motion: CrankMotion
    """Its angle is zero at its start, not at a mark on the shaft: phases of orders are relative."""
    time_s: Array
    """Centres of the frames."""
    confidence: Array
    """Of each frame, 0 to 1: likelihood of its speed over the sum of it and of that of the best
    speed more than 5 % away. Above 0.5 the speed explains the frame better than every other one
    within the limits; in noise its mean is 0.3 to 0.5."""


def tacholess_motion(
    signal: Array,
    sample_rate_hz: float,
    minimum_frequency_hz: float,
    maximum_frequency_hz: float,
    orders: Sequence[float] = tuple(range(1, 11)),
    maximum_change_per_s: float = 1.0,
) -> TacholessResult:
    """Crank motion of a shaft from the orders in a signal, without a tacho.

    Each frame gives every candidate speed a score (`comb_scores`); dynamic programming finds the
    path of the largest sum whose speed changes no faster than the bound (Viterbi 1967), with a cost
    that grows with the square of the change. A second round takes spectra that are straightened by
    the first one's path; refined speeds are smoothed (`smooth_curve`). The motion reaches from the
    centre of the first frame to that of the last.

    Parameters
    ----------
    signal : shape (time,), of one channel, any unit
    sample_rate_hz : samples per second
    minimum_frequency_hz, maximum_frequency_hz : of the shaft; frames are as long as eight
        revolutions at the lowest
    orders : rising, that may be present; not all have to be
    maximum_change_per_s : largest relative change of the speed, 1/s

    Raises
    ------
    ParameterError
        The signal is empty, not finite, constant or shorter than 24 revolutions at the lowest
        frequency, the frequencies are not 0 < minimum < maximum, the orders do not rise from above
        zero, or half the sample rate is below the lowest order.
    """
    order = np.asarray(orders, dtype=float)
    _check(signal, sample_rate_hz, minimum_frequency_hz, maximum_frequency_hz, order)
    down = max(1, int(sample_rate_hz / (_OVERSAMPLING * order[-1] * maximum_frequency_hz)))
    samples, rate = scipy.signal.resample_poly(signal, 1, down), sample_rate_hz / down
    length = next_fast_len(int(_REVOLUTIONS * rate / minimum_frequency_hz), real=True)
    centres = 0.5 * (length - 1) + np.arange(
        0, samples.size - length + 1, length / _FRAMES_PER_LENGTH
    )
    _check_length(centres, signal.size / sample_rate_hz, minimum_frequency_hz)
    bin_hz, time_s = 0.5 * rate / length, centres / rate
    span = np.log(maximum_frequency_hz / minimum_frequency_hz)
    candidates = minimum_frequency_hz / bin_hz * np.exp(np.arange(0.0, span, _GRID))
    reach = max(1, int(maximum_change_per_s * (time_s[1] - time_s[0]) / _GRID))
    floor_bins = 12 * _REVOLUTIONS + 1
    change = np.zeros(centres.size)
    for _ in range(2):
        levels = frame_levels(samples, centres, length, change / rate, floor_bins)
        score = comb_scores(levels, order, candidates)
        path = _best_path(score, reach, _BOUND_COST)
        speed_hz = bin_hz * refine(levels, order, candidates, path)
        smooth = smooth_curve(time_s, speed_hz).curve
        change = np.clip(
            smooth(time_s, 1) / smooth(time_s), -maximum_change_per_s, maximum_change_per_s
        )
    angle = PPoly(2.0 * np.pi * smooth.c, smooth.x).antiderivative()
    return TacholessResult(from_curve(angle), time_s, _confidence(score, path))


def _check(signal: Array, rate: float, minimum: float, maximum: float, orders: Array) -> None:
    if signal.ndim != 1 or not np.all(np.isfinite(signal)):
        raise ParameterError("signal: needs finite samples of one channel")
    if signal.size == 0 or np.ptp(signal) == 0.0:
        raise ParameterError(f"signal: {signal.size} samples, all the same; no speed is in them")
    if not 0.0 < minimum < maximum:
        raise ParameterError(
            f"minimum_frequency_hz = {minimum:g} Hz, maximum_frequency_hz = {maximum:g} Hz: must "
            "rise from above zero"
        )
    if orders.size == 0 or not np.all(np.diff(orders, prepend=0.0) > 0.0):
        raise ParameterError(f"orders = {orders.tolist()}: must rise from above zero")
    if not orders[0] * maximum < 0.5 * rate:
        raise ParameterError(
            f"maximum_frequency_hz = {maximum:g} Hz: order {orders[0]:g} is not below half the "
            f"sample rate of {rate:g} Hz"
        )


def _check_length(centres: Array, duration_s: float, minimum: float) -> None:
    if centres.size < _LEAST_FRAMES:
        raise ParameterError(
            f"signal: {duration_s:.4g} s are too short for a speed from {minimum:g} Hz; needs "
            f"{3 * _REVOLUTIONS / minimum:.4g} s, or a higher minimum_frequency_hz"
        )


def _confidence(score: Array, path: NDArray[np.int64]) -> Array:
    frame, candidate = np.ogrid[: score.shape[0], : score.shape[1]]
    far = np.abs(candidate - path[:, None]) * _GRID > _OFF_PATH
    rival = np.max(np.where(far, score, -np.inf), axis=1)
    on_path = score[frame[:, 0], path]
    return np.asarray(1.0 / (1.0 + np.exp(np.clip(rival - on_path, -500.0, 500.0))))


@numba.njit(cache=True, nogil=True)
def _best_path(score: Array, reach: int, bound_cost: float) -> NDArray[np.int64]:
    """Candidate of each frame, for the largest sum of scores less the cost of changes."""
    frames, candidates = score.shape
    origin = np.zeros((frames, candidates), np.int64)
    total = score[0].copy()
    for frame in range(1, frames):
        gained = np.full(candidates, -np.inf)
        for i in range(candidates):
            for j in range(max(0, i - reach), min(candidates, i + reach + 1)):
                value = total[j] - bound_cost * ((i - j) / reach) ** 2
                if value > gained[i]:
                    gained[i], origin[frame, i] = value, j
        total = gained + score[frame]
    path = np.zeros(frames, np.int64)
    path[-1] = np.argmax(total)
    for frame in range(frames - 1, 0, -1):
        path[frame - 1] = origin[frame, path[frame]]
    return path
