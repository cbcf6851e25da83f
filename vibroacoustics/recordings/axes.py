"""Time axes of channels, each stated or read, brought to one time line."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .recorded import MissingError, Request, check_rate, check_size
from .time_axis import (
    MAXIMUM_TIME_DEVIATION,
    Times,
    UnevenError,
    check_gap,
    check_growing,
    even_part,
)
from .time_line import ChannelTime, TimeLine, time_line

_MOST_TIMES: Final = 2**22
"""Most times that are read for every block."""
_DIGITS: Final = range(7)
"""Decimal digits of times that may be rounded to them."""
_ROUNDING: Final = 0.55
"""Share of the last digit by which rounded times deviate from an even grid."""


@dataclass(frozen=True, eq=False)
class Axis:
    """Time axis of channels.

    Attributes
    ----------
    samples : number of samples
    rate_hz : sample rate; None where the times give it
    start_s : time of the first sample, s; of times their origin
    times : times in s from one sample to another; None where the rate is stated alone
    origin_s : time of the recording's first sample, where that is not of the times
    """

    samples: int
    rate_hz: float | None = None
    start_s: float = 0.0
    times: Times | None = None
    origin_s: float | None = None


def line_of(names: Sequence[str], axes: Sequence[Axis], request: Request) -> TimeLine:
    """Time line of channels.

    Of a single axis only the times of the part that is wanted are read.

    Parameters
    ----------
    names : names of the channels
    axes : axis of each channel; channels may share one
    request : part that is wanted, and the sample rate that overrides those of the axes

    Raises
    ------
    ParameterError
        Times do not grow or have a gap, or channels have no common time.
    """
    single = axes[0] if axes and all(axis is axes[0] for axis in axes) else None
    is_single = single is not None and single.times is not None and request.line is None
    if single is not None and is_single and _may_be_even(single, request):
        try:
            return _even_line(names, single, request)
        except UnevenError:
            if request.samples is not None:
                raise
    read = {id(axis): _channel_time(axis, request) for axis in axes}
    times = [
        ChannelTime(name, time.samples, time.rate_hz, time.start_s, time.uneven_s)
        for name, time in zip(names, (read[id(axis)] for axis in axes), strict=True)
    ]
    return time_line(times, request)


def line_of_times(
    names: Sequence[str], time_s: Array, request: Request, origin_s: float | None = None
) -> TimeLine:
    """Time line of all of the channels that share times which are in memory.

    Parameters
    ----------
    names : names of the channels
    time_s : growing times, s, shape (time,)
    request : its sample rate overrides that of the times
    origin_s : time of the recording's first sample, where that is not of the times
    """
    axis = Axis(time_s.size, times=lambda first, last: time_s[first:last], origin_s=origin_s)
    return line_of(names, [axis] * len(names), request.every)


def _may_be_even(axis: Axis, request: Request) -> bool:
    """Whether even times are looked for in what is wanted alone; blocks must agree in it."""
    if request.samples is None or axis.samples > _MOST_TIMES or axis.times is None:
        return True
    time_s = np.asarray(axis.times(0, axis.samples), dtype=float)
    try:
        check_growing(time_s, 0)
        check_gap(time_s, 0, 0.0, request.sample_rate_hz)
    except ParameterError:
        return True  # the part without it may be read
    is_stated = request.sample_rate_hz is not None or axis.rate_hz is not None
    return is_stated or is_even(time_s, (time_s.size - 1) / (time_s[-1] - time_s[0]))


def _even_line(names: Sequence[str], axis: Axis, request: Request) -> TimeLine:
    """Line of even times, of which the part alone must be even."""
    assert axis.times is not None  # noqa: S101 - the caller has looked
    first, last, rate_hz = even_part(axis.times, axis.samples, request, axis.origin_s)
    rate_hz = _agreed_hz(axis.rate_hz, rate_hz, last - first, request)
    check_rate(rate_hz)
    start_s = axis.start_s + float(axis.times(0, 1)[0])
    time = [ChannelTime(name, axis.samples, rate_hz, start_s) for name in names]
    return TimeLine(time, rate_hz, start_s, axis.samples, first, last, request.is_block)


def _channel_time(axis: Axis, request: Request) -> ChannelTime:
    """Time of a channel without its name."""
    rate_hz = request.sample_rate_hz or axis.rate_hz
    if axis.times is None:
        if rate_hz is None:
            raise MissingError("has no time axis and no sample rate: give sample_rate_hz")
        check_rate(rate_hz)
        return ChannelTime("", axis.samples, rate_hz, axis.start_s)
    check_size(0, axis.samples)
    time_s = np.asarray(axis.times(0, axis.samples), dtype=float)
    check_growing(time_s, 0)
    check_gap(time_s, 0, float(time_s[0]), request.sample_rate_hz)
    time_s = time_s + axis.start_s
    mean_hz = float((time_s.size - 1) / (time_s[-1] - time_s[0]))
    if rate_hz is None and not is_even(time_s, mean_hz):
        rounded_hz = rounded_rate_hz(time_s)
        if rounded_hz is None:
            return ChannelTime("", axis.samples, mean_hz, float(time_s[0]), time_s)
        rate_hz = rounded_hz
    rate_hz = _agreed_hz(rate_hz, mean_hz, time_s.size, request)
    return ChannelTime("", axis.samples, rate_hz, float(time_s[0]))


def _agreed_hz(stated_hz: float | None, rate_hz: float, samples: int, request: Request) -> float:
    """Sample rate that is stated, with which that of the times must agree.

    Raises
    ------
    ParameterError
        They differ by more than a sample.
    """
    if stated_hz is None or request.sample_rate_hz is not None:
        return request.sample_rate_hz or rate_hz
    if not abs(stated_hz / rate_hz - 1.0) * samples <= 1.0:
        raise ParameterError(
            f"states a sample rate of {stated_hz:.9g} Hz, but its time axis has {rate_hz:.9g} Hz: "
            "give sample_rate_hz"
        )
    return stated_hz


def is_even(time_s: Array, rate_hz: float) -> bool:
    """Whether times, s, shape (time,), are on the grid of a rate from the first."""
    off = (time_s - time_s[0]) * rate_hz - np.arange(time_s.size)
    return bool(np.max(np.abs(off)) <= MAXIMUM_TIME_DEVIATION)


def rounded_rate_hz(time_s: Array) -> float | None:
    """Sample rate of even times that are rounded to a decimal digit; None where they are not.

    Parameters
    ----------
    time_s : growing times, s, shape (time,)
    """
    number = np.arange(time_s.size, dtype=float)
    slope, start = np.polyfit(number, time_s, 1)
    off_s = float(np.max(np.abs(time_s - start - slope * number)))
    for digits in _DIGITS:
        quantum = 10.0**-digits
        steps = time_s / quantum
        if np.max(np.abs(steps - np.rint(steps))) < 1e-3:
            return float(1.0 / slope) if off_s <= _ROUNDING * quantum else None
    return None
