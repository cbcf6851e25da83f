"""Missing and double pulses of a tacho, and the number of each pulse that is left."""

from dataclasses import dataclass
from typing import Final, Literal

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from ..base.arrays import Array
from ..base.errors import ParameterError

Indices = NDArray[np.int64]

_HALF_WINDOW: Final = 10
"""Intervals to each side over whose median the local period is taken: five double pulses in a row,
each of which makes two short intervals, stay a minority."""
_EDGE: Final = 5
_DISCARD_COST: Final = 0.2
"""A double pulse left in costs at least 1/2: (1 - a)² + a² for one that parts a period at a. A real
pulse that is 30 % of a period late costs 0.18 and is kept."""
_GAP_COST: Final = 0.1
"""Makes it dearer to drop a real pulse than to keep it."""
_LOOK_BACK: Final = 64
"""Most pulses in a row that may be doubles."""
_MOST_FAULTS: Final = 0.25
"""Share of the pulses above which they are no train of pulses."""
_COINCIDENT: Final = 1e-12
"""Share of the whole time: pulses closer than that differ by rounding only."""


@dataclass(frozen=True)
class PulseFault:
    """A pulse that was expected and did not come, or one too many."""

    kind: Literal["missing", "double"]
    time_s: float
    """Time at which it came, or should have come."""


@dataclass(frozen=True)
class NumberedPulses:
    """Pulses of a steady train with their numbers; a gap in the numbers is a missing pulse."""

    time_s: Array
    number: Indices
    faults: tuple[PulseFault, ...]
    """Faults in the order of time."""


def number_pulses(time_s: Array) -> NumberedPulses:
    """Number the pulses of a tacho, leaving out doubles and counting missing ones.

    The numbers are those of least cost, by dynamic programming over the pulses: the squared
    deviation of each interval, in local periods, from a whole number, plus a cost for each pulse
    left out and for each gap. The local period is the running median of the intervals, which
    follows a run-up; the second of two rounds takes it from the pulses that the first one kept. The
    time of a missing pulse is interpolated.

    Parameters
    ----------
    time_s : shape (pulses,), rising; three pulses at least

    Raises
    ------
    ParameterError
        There are fewer than three pulses, their times do not rise, or more than a quarter of them
        are faults: that is no tacho signal.
    """
    _check_times(time_s)
    kept: Indices = np.arange(time_s.size)
    number: Indices = kept
    for _ in range(2):
        kept, number = _cheapest(time_s, _pulse_rate(time_s, time_s[kept], number))
        faults = number[-1] + 1 - kept.size + time_s.size - kept.size
        if faults > _MOST_FAULTS * time_s.size:
            raise ParameterError(
                f"tacho: {faults} missing or double pulses among {time_s.size}: they do not "
                "follow each other evenly; check the threshold and the channel"
            )
    return NumberedPulses(time_s[kept], number, _list_faults(time_s, kept, number))


def _check_times(time_s: Array) -> None:
    if time_s.ndim != 1 or time_s.size < 3:
        raise ParameterError(f"tacho: {time_s.size} pulses; a speed needs at least 3")
    least_s = _COINCIDENT * (time_s[-1] - time_s[0])
    if not np.all(np.isfinite(time_s)) or not np.all(np.diff(time_s) > max(least_s, 0.0)):
        raise ParameterError("tacho: the times of the pulses do not rise")


def _pulse_rate(at_s: Array, time_s: Array, number: Indices) -> Array:
    """Local number of pulses per second at some times, from numbered pulses."""
    period = np.exp(_running_median(np.log(np.diff(time_s) / np.diff(number))))
    return np.interp(at_s, 0.5 * (time_s[1:] + time_s[:-1]), 1.0 / period)


def _running_median(values: Array) -> Array:
    """Running median that keeps a trend up to the ends, by point reflection of the values there."""
    half = min(_HALF_WINDOW, values.size // 2)
    edge = min(_EDGE, values.size - half)
    before = 2.0 * np.median(values[:edge]) - values[edge : edge + half][::-1]
    after = 2.0 * np.median(values[-edge:]) - values[::-1][edge : edge + half]
    padded = np.concatenate([before, values, after])
    return np.asarray(median_filter(padded, 2 * half + 1)[half : half + values.size])


def _cheapest(time_s: Array, rate: Array) -> tuple[Indices, Indices]:
    """Positions of the pulses to keep and their numbers from zero."""
    previous, steps, last = _search(time_s, rate)
    chain = [last]
    while previous[chain[-1]] >= 0:
        chain.append(int(previous[chain[-1]]))
    kept = np.array(chain[::-1])
    return kept, np.concatenate([[0], np.cumsum(steps[kept[1:]])])


@numba.njit(cache=True, nogil=True)
def _search(time_s: Array, rate: Array) -> tuple[Indices, Indices, int]:
    """Find for each pulse the cheapest one before it and the periods between; the cheapest last
    one."""
    cost = _DISCARD_COST * np.arange(time_s.size)
    previous = np.full(time_s.size, -1)
    steps = np.zeros(time_s.size, np.int64)
    for i in range(time_s.size):
        for j in range(i - 1, max(i - 2 - _LOOK_BACK, -1), -1):
            periods = 0.5 * (rate[i] + rate[j]) * (time_s[i] - time_s[j])
            period_count = max(1, round(periods))
            if j < i - 1 and period_count > 2:
                break
            candidate = cost[j] + (periods - period_count) ** 2 + _DISCARD_COST * (i - 1 - j)
            candidate += _GAP_COST if period_count > 1 else 0.0
            if candidate < cost[i]:
                cost[i], previous[i], steps[i] = candidate, j, period_count
    tail = cost + _DISCARD_COST * np.arange(time_s.size)[::-1]
    return previous, steps, int(np.argmin(tail))


def _list_faults(time_s: Array, kept: Indices, number: Indices) -> tuple[PulseFault, ...]:
    doubles = np.setdiff1d(np.arange(time_s.size), kept)
    missing = np.setdiff1d(np.arange(number[-1]), number)
    expected_s = np.interp(missing, number, time_s[kept])
    faults = [PulseFault("double", float(t)) for t in time_s[doubles]]
    faults += [PulseFault("missing", float(t)) for t in expected_s]
    return tuple(sorted(faults, key=lambda fault: fault.time_s))
