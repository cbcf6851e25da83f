"""Sample rate of a time axis, and the part of it that is wanted."""

from collections.abc import Callable
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .recorded import MINIMUM_SAMPLES, Request, Samples, check_size

MAXIMUM_TIME_DEVIATION: Final = 0.05
"""Largest distance of a sample's time from the even grid, in sampling intervals: the rounding of
times written in microseconds at 100 kHz. More makes a phase error above 2° at a tenth of the
sample rate, if it is no rounding."""
_GAP: Final = 1.5
"""Sampling intervals from one sample to the next that are a gap; rounded times have less than 2."""
_ROUNDED_GAP: Final = 2.0


class UnevenError(ParameterError):
    """Times are not even; they can be resampled."""


Times = Callable[[int, int], Samples]
"""Times in s from one sample up to, but not with, another."""


def even_part(
    times: Times, samples: int, request: Request, origin_s: float | None = None
) -> tuple[int, int, float]:
    """First sample that is wanted, the one behind the last, and the sample rate.

    The rate is (N - 1) / (t_N - t_1), from the end points of the part or, of a block, of the whole
    axis; the request's overrides it.

    Parameters
    ----------
    times : times of the axis; of a part only its times are read
    samples : number of samples of the axis
    request : part that is wanted
    origin_s : time of the recording's first sample, where that is not of the axis

    Raises
    ------
    ParameterError
        The times do not grow, are not even or have a gap, or the part is empty.
    """
    if samples < MINIMUM_SAMPLES:
        raise ParameterError(f"time has {samples} values; at least {MINIMUM_SAMPLES} are needed")
    start, end = float(times(0, 1)[0]), float(times(samples - 1, samples)[0])
    if request.from_s is None and request.to_s is None:
        first, last = request.part(samples, 1.0)
    else:
        first, last = _between(times, samples, start, end, request)
    check_size(0, last - first)
    time = np.asarray(times(first, last), dtype=float)
    check_growing(time, first)
    check_gap(time, first, start if origin_s is None else origin_s, request.sample_rate_hz)
    if request.sample_rate_hz is not None:
        return first, last, request.sample_rate_hz
    if request.samples is not None and time.size == 0:
        return first, last, (samples - 1) / (end - start)
    if request.samples is not None:  # a block is even with all others
        rate_hz = (samples - 1) / (end - start)
        _check_even(time, start, rate_hz, first, first)
    else:
        rate_hz = (time.size - 1) / (time[-1] - time[0])
        _check_even(time, time[0], rate_hz, 0, first)
    return first, last, float(rate_hz)


def _between(
    times: Times, samples: int, start: float, end: float, request: Request
) -> tuple[int, int]:
    """Samples from one time to another, by halving: only few times are read."""
    half = 0.5 * (end - start) / (samples - 1)  # the nearest sample counts
    first = 0 if request.from_s is None else _begin(times, samples, start + request.from_s - half)
    last = samples if request.to_s is None else _begin(times, samples, start + request.to_s - half)
    if last - first < MINIMUM_SAMPLES:
        raise ParameterError(
            f"from_s = {request.from_s or 0.0:g} s to to_s = "
            f"{end - start if request.to_s is None else request.to_s:g} s: holds {last - first} "
            f"samples; the recording lasts {end - start:.9g} s"
        )
    return first, last


def _begin(times: Times, samples: int, time_s: float) -> int:
    """First sample whose time is not before the given one."""
    low, high = 0, samples
    while low < high:
        middle = (low + high) // 2
        if float(times(middle, middle + 1)[0]) < time_s:
            low = middle + 1
        else:
            high = middle
    return low


def check_growing(time: Array, first: int) -> None:
    """Refuse times, shape (time,), that do not grow; the first is that of sample `first`."""
    wrong = np.flatnonzero(~(np.diff(time) > 0.0))  # not a number is wrong too
    if wrong.size:
        sample = int(wrong[0])
        raise ParameterError(
            f"time does not grow from sample {first + sample + 1} ({time[sample]:.9g} s) to the "
            f"next ({time[sample + 1]:.9g} s)"
        )


def check_gap(time: Array, first: int, start: float, stated_hz: float | None) -> None:
    """Refuse missing samples; an analysis over them would be silently wrong."""
    steps = np.diff(time)
    if not steps.size:
        return
    interval = float(np.median(steps)) if stated_hz is None else 1.0 / stated_hz
    gaps = np.flatnonzero(steps >= (_GAP if stated_hz is None else _ROUNDED_GAP) * interval)
    if gaps.size and gaps.size < 0.1 * steps.size:  # else the times are uneven all over
        sample = int(gaps[0])
        before, behind = time[sample] - start, time[sample + 1] - start
        raise ParameterError(
            f"time has {gaps.size} gap{'s' if gaps.size > 1 else ''}, the first of "
            f"{steps[sample]:.6g} s behind sample {first + sample + 1} ({before:.9g} s), where the "
            f"interval is {interval:.6g} s: choose a part without one, as to_s = {before:.9g} or "
            f"from_s = {behind:.9g}"
        )


def _check_even(time: Array, origin: float, rate_hz: float, number: int, first: int) -> None:
    """Refuse times off the grid on which sample `number` is the first that is given."""
    deviation = np.abs((time - origin) * rate_hz - np.arange(number, number + time.size))
    sample = int(np.argmax(deviation))
    if not deviation[sample] <= MAXIMUM_TIME_DEVIATION:
        raise UnevenError(
            f"time is not even: sample {first + sample + 1} lies {deviation[sample]:.3g} sampling "
            f"intervals off the grid of {rate_hz:.9g} Hz, allowed are {MAXIMUM_TIME_DEVIATION:g}; "
            "if the times are only rounded, give sample_rate_hz"
        )
