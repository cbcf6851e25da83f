"""Speed profiles that explain short spectra of a signal best."""

from dataclasses import dataclass
from typing import Final

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len
from scipy.interpolate import PPoly

from ..base.arrays import Array
from ..base.errors import ParameterError
from .speed_comb import comb_scores, frame_levels, refine, smooth_curve

REVOLUTIONS: Final = 8
"""Revolutions in a frame at the lowest speed: the lines of its orders lie four Hann half-widths
apart."""
_FRAMES_PER_LENGTH: Final = 4
_LEAST_FRAMES: Final = 9
"""Three frame lengths."""
_GRID: Final = 0.002
"""Ratio between neighbouring candidates, less one. The peak of the tenth order is 1 % wide or more
up to six times the lowest speed."""
_BOUND_COST: Final = 4.0
"""Cost of a change of speed at the bound, in units of ln likelihood: a line 17 dB above the
noise."""
MOST_LEVEL: Final = 3.0
"""Level of a line where no line shall outweigh several, in ln of power over floor: 14 dB."""
_OFF_PATH: Final = 0.05
"""Relative distance from which a speed counts as another one."""


@dataclass(frozen=True)
class SpeedProfile:
    """Speed over time.

    Attributes
    ----------
    curve : speed in Hz over time in s, smooth
    time_s : centres of the frames that it comes from, shape (frame,)
    confidence : confidence of each frame, see `TacholessResult`
    """

    curve: PPoly
    time_s: Array
    confidence: Array


@dataclass(frozen=True)
class Search:
    """Settings of the search for a speed.

    Attributes
    ----------
    samples : shape (time,), of a rate that holds the orders
    rate_hz : rate of the samples
    orders : orders of the comb, rising, shape (order,)
    minimum_hz, maximum_hz : limits of the speed
    change_per_s : largest relative change of the speed, 1/s
    """

    samples: Array
    rate_hz: float
    orders: Array
    minimum_hz: float
    maximum_hz: float
    change_per_s: float

    @property
    def length(self) -> int:
        """Samples of a frame."""
        return int(next_fast_len(int(REVOLUTIONS * self.rate_hz / self.minimum_hz), real=True))

    def centres(self) -> Array:
        """Centres of the frames, in samples.

        Raises
        ------
        ParameterError
            The signal is too short for three frames.
        """
        step = self.length / _FRAMES_PER_LENGTH
        starts = np.arange(0, self.samples.size - self.length + 1, step)
        if starts.size < _LEAST_FRAMES:
            raise ParameterError(
                f"signal: {self.samples.size / self.rate_hz:.4g} s are too short for a speed from "
                f"{self.minimum_hz:g} Hz; needs {3 * REVOLUTIONS / self.minimum_hz:.4g} s, or a "
                "higher minimum_frequency_hz"
            )
        return np.asarray(0.5 * (self.length - 1) + starts, dtype=np.float64)


def best_profiles(search: Search) -> list[SpeedProfile]:
    """The speed profile with the largest score, the best one that keeps off it, that of moving
    lines.

    Each frame gives every candidate speed a score (`comb_scores`); dynamic programming finds the
    path of the largest sum whose speed changes no faster than the bound (Viterbi 1967), with a cost
    that grows with the square of the change. A second round takes spectra that are straightened by
    the first one's path; refined speeds are smoothed (`smooth_curve`). For the last speed profile,
    the median over time is taken off the first round's spectra: what stands still is not the shaft
    of a run-up.
    """
    first, path = _profile(search)
    return [
        first,
        _profile(search, avoid=path)[0],
        _profile(search, most=MOST_LEVEL)[0],
        _profile(search, most=MOST_LEVEL, is_moving=True)[0],
    ]


def _profile(
    search: Search,
    avoid: NDArray[np.int64] | None = None,
    most: float = np.inf,
    is_moving: bool = False,
) -> tuple[SpeedProfile, NDArray[np.int64]]:
    """Best speed profile and its path: off a path, with levels up to a bound, of moving lines."""
    centres, length = search.centres(), search.length
    bin_hz, time_s = 0.5 * search.rate_hz / length, centres / search.rate_hz
    span = np.log(search.maximum_hz / search.minimum_hz)
    candidates = search.minimum_hz / bin_hz * np.exp(np.arange(0.0, span, _GRID))
    bound = search.change_per_s
    reach = max(1, int(bound * (time_s[1] - time_s[0]) / _GRID))
    change = np.zeros(centres.size)
    for is_first in (True, False):
        levels = frame_levels(
            search.samples, centres, length, change / search.rate_hz, 12 * REVOLUTIONS + 1
        )
        if is_moving and is_first:
            levels -= np.maximum(np.median(levels, axis=0), 0.0)
        score = comb_scores(np.minimum(levels, most), search.orders, candidates)
        allowed = score if avoid is None else np.where(_near(score, avoid), score.min(), score)
        path = _best_path(allowed, reach, _BOUND_COST)
        speed_hz = bin_hz * refine(levels, search.orders, candidates, path)
        smooth = smooth_curve(time_s, speed_hz).curve
        change = np.clip(smooth(time_s, 1) / smooth(time_s), -bound, bound)
    confidence = _confidence(comb_scores(levels, search.orders, candidates), path)
    return SpeedProfile(smooth, time_s, confidence), path


def _near(score: Array, path: NDArray[np.int64]) -> NDArray[np.bool_]:
    candidate = np.arange(score.shape[1])
    return np.asarray(np.abs(candidate - path[:, None]) * _GRID <= _OFF_PATH)


def _confidence(score: Array, path: NDArray[np.int64]) -> Array:
    rival = np.max(np.where(_near(score, path), -np.inf, score), axis=1)
    on_path = score[np.arange(path.size), path]
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
