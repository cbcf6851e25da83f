"""Height of tacho pulses over time: that of an inductive pickup grows with the speed."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.ndimage import median_filter

from ..base.arrays import Array

EVEN_HEIGHT: Final = 0.8
"""Least height over the largest one, above which the threshold stays as it is."""
_NEIGHBOURS: Final = 5
"""Pulses over which the median of heights and intervals is taken: two spikes have no effect."""
_BEYOND: Final = 0.5
"""Height that is expected beyond the first and last pulse, over theirs."""
_LEAST_SWING: Final = 0.6
"""Least swing before and behind a further pulse, over that of its neighbours."""
_SECOND_LOBE: Final = 0.6
"""Height of the lobe behind the last pulse of an inductive pickup, which has half its swing
there."""
_INTERVALS: Final = (0.6, 3.6)
"""Interval of a further pulse over that of its neighbours: a tooth or two may be missing."""
_SILENT: Final = 2.5
"""Longest interval, over the longest of its neighbours, in which no pulse is missed."""
_LONGEST_OF: Final = 150
"""Intervals to each side of a stretch among which the longest counts: a wheel's missing teeth come
again within them."""


@dataclass(frozen=True)
class Heights:
    """Height of the pulses over the largest one, linear between pulses.

    Attributes
    ----------
    sample : sample numbers of the pulses, shape (pulse,)
    height : height of each, 0 to 1, shape (pulse,)
    """

    sample: Array
    height: Array

    @property
    def least(self) -> float:
        """Least height."""
        return float(self.height.min())

    def height_at(self, first: int, samples: int) -> Array:
        """Height at samples from a first one; half of the last one beyond the pulses."""
        before, behind = self.sample[1] - self.sample[0], self.sample[-1] - self.sample[-2]
        ends = np.array([1.0, 0.5])
        sample = [
            self.sample[0] - before * ends,
            self.sample,
            self.sample[-1] + behind * ends[::-1],
        ]
        ends = np.array([_BEYOND, 1.0])
        height = [self.height[0] * ends, self.height, self.height[-1] * ends[::-1]]
        number = np.arange(first, first + samples, dtype=np.float64)
        return np.asarray(np.interp(number, np.concatenate(sample), np.concatenate(height)))


def heights_of(pulses: Array, swings: Array) -> Heights | None:
    """Running median of the heights; None of too few pulses.

    Parameters
    ----------
    pulses : in samples, shape (pulse,)
    swings : swings of the signal before, between and behind the pulses, shape (pulse + 1,)
    """
    if pulses.size < _NEIGHBOURS:
        return None
    height = median_filter(np.concatenate([swings[1:2], swings[1:-1]]), _NEIGHBOURS, mode="nearest")
    return Heights(pulses, height / height.max())


def continued(numbers: Array, pulses: Array, swings: Array, has_lobes: bool) -> tuple[Array, Array]:
    """Pulses between the known ones, and those beyond that go on as evenly, with their swings.

    A pulse goes on while swings and interval are near those of the pulses before it: noise at
    standstill does not.

    Parameters
    ----------
    numbers : pulses of the round before, shape (pulse,), samples
    pulses, swings : pulses and swings of this round, see `heights_of`
    has_lobes : whether the pulses go to both sides of a rest
    """
    behind = _LEAST_SWING * (_SECOND_LOBE if has_lobes else 1.0)
    inner = np.flatnonzero((pulses >= numbers[0] - 0.5) & (pulses <= numbers[-1] + 0.5))
    if inner.size < _NEIGHBOURS:
        return pulses[inner], np.append(swings[inner], 0.0)
    interval = np.diff(pulses)
    last = _reach(interval, swings, int(inner[-1]), behind)
    end = pulses.size - 1
    first = end - _reach(interval[::-1], swings[::-1], end - int(inner[0]), behind)
    return pulses[first : last + 1], swings[first : last + 2]


def _reach(interval: Array, swings: Array, start: int, behind: float) -> int:
    """Last pulse up to which the train goes on, from one at which it does.

    Parameters
    ----------
    interval : between neighbours, shape (pulse - 1,)
    swings : swings, see `heights_of`
    start : pulse, with some before it
    behind : least swing behind a further pulse, over that of its neighbours
    """
    least, most = _INTERVALS
    for number in range(start, interval.size):
        first = max(number - _NEIGHBOURS, 0)
        usual = np.median(swings[first + 1 : number + 1])
        ratio = interval[number] / np.median(interval[first:number])
        # The swing before a first pulse of noise is still that of the last pulse.
        is_high = swings[number + 1] > _LEAST_SWING * usual and swings[number + 2] > behind * usual
        if not (least < ratio < most and is_high):
            return number
    return int(interval.size)


def silent_parts(time: Array, start: float, end: float) -> list[tuple[float, float]]:
    """Stretches without pulses, before, between and behind them.

    Parameters
    ----------
    time : time of the pulses, rising, shape (pulse,), two at least
    start, end : start and end of the recording, in the unit of the pulses' time
    """
    borders = np.concatenate([[start], time, [end]])
    interval = np.diff(borders)
    inner = interval[1:-1]
    parts = []
    for number in np.flatnonzero(interval > _SILENT * np.median(inner)):
        low = max(number - 1 - _LONGEST_OF, 0)
        beside = np.concatenate(
            [inner[low : max(number - 1, 0)], inner[number : number + _LONGEST_OF]]
        )
        if beside.size == 0 or interval[number] > _SILENT * beside.max():
            parts.append((float(borders[number]), float(borders[number + 1])))
    return parts


def end_is_silent(pulses: Array, samples: int) -> bool:
    """Whether the signal goes on without pulses before the first or behind the last one."""
    if pulses.size < 2:
        return False
    parts = silent_parts(pulses, 0.0, samples - 1.0)
    return any(begin == 0.0 or end == samples - 1.0 for begin, end in parts)
