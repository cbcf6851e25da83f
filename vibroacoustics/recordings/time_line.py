"""One time line for channels that start, or are sampled, at different times."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from math import ceil, floor
from typing import Any, Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .overload import overload
from .recorded import MINIMUM_SAMPLES, Recorded, Request, Samples, check_rate, listed
from .remarks import may_be_full
from .resampling import HALF_LENGTH, band_limited, cubic, prediction_error, spline
from .scaling import check_finite

LEAST_SHIFT: Final = 1e-3
"""Sampling intervals that count as none: 0.1° at a quarter of the sample rate."""
_SAME_RATE: Final = 0.05
"""Sampling intervals by which two clocks may drift apart over a recording and still be one."""
_SLOW: Final = 8.0
"""Ratio of rates from which on a channel is slow: a speed, a temperature. Cubics fit those."""
_MOST_PREDICTED: Final = 2**18
"""Samples of a slow channel by which its interpolation is judged."""


@dataclass(frozen=True, eq=False)
class ChannelTime:
    """Time of one channel of a file.

    Attributes
    ----------
    name : name of the channel
    samples : number of samples
    rate_hz : sample rate; of uneven times the mean one
    start_s : time of the first sample, s from an origin that all channels share
    uneven_s : times from that origin where they are not even, s, shape (time,)
    """

    name: str
    samples: int
    rate_hz: float
    start_s: float = 0.0
    uneven_s: Array | None = None

    @property
    def end_s(self) -> float:
        """Time of the last sample."""
        if self.uneven_s is not None:
            return float(self.uneven_s[-1])
        return self.start_s + (self.samples - 1) / self.rate_hz


@dataclass(frozen=True)
class TimeLine:
    """Time line of a recording: the common part of its channels at the fastest rate.

    Attributes
    ----------
    times : time of each channel
    rate_hz : sample rate
    start_s : time of its first sample, s from the origin of the channels
    total : number of samples
    first, last : samples that are wanted, the last one excluded
    is_block : whether they are a block, on which nothing is remarked
    """

    times: Sequence[ChannelTime]
    rate_hz: float
    start_s: float
    total: int
    first: int
    last: int
    is_block: bool

    @property
    def parts(self) -> list[tuple[int, int]]:
        """First sample that is needed of each channel, and the one after the last."""
        return [self._part(time) for time in self.times]

    @property
    def key(self) -> tuple[float, float, int] | None:
        """Rate, start and samples; None where each channel has its samples at all of its times."""
        copies = all(self._is_even_copy(time) for time in self.times)
        if copies and {(time.start_s, time.samples) for time in self.times} == {
            (self.start_s, self.total)
        }:
            return None
        return self.rate_hz, self.start_s, self.total

    def planned(self, request: Request) -> "TimeLine":
        """Line with the samples that are wanted now or, of a file that is opened, in blocks."""
        first, last = request.planned(self.total, self.rate_hz)
        return replace(self, first=first, last=last)

    def is_resampled(self, channel: int) -> bool:
        """Whether the samples of a channel are interpolated."""
        return not self._is_even_copy(self.times[channel])

    def on_grid(self, stored: Sequence[Samples]) -> list[Samples]:
        """Samples of each channel at the times of the line.

        Parameters
        ----------
        stored : samples of the `parts`, shape (time,) each
        """
        return [
            self._resampled(time, part, samples)
            for time, part, samples in zip(self.times, self.parts, stored, strict=True)
        ]

    def remarks(self, units: Sequence[str], stored: Sequence[Samples]) -> list[str]:
        """Remarks on what is cut and interpolated, with the error.

        Parameters
        ----------
        units : unit of each channel in the file
        stored : samples of the `parts`, shape (time,) each
        """
        if self.is_block:
            return []
        lines = self._cut()
        for time, unit, part, samples in zip(self.times, units, self.parts, stored, strict=True):
            lines += self._interpolated(time, unit, part[0], samples)
        return lines

    def recorded(
        self, names: Sequence[str], units: Sequence[str], stored: Sequence[Samples],
        origin: str = "", remarks: Sequence[str] = (), **further: Any,
    ) -> Recorded:  # fmt: skip
        """Recording of the part that is wanted.

        Parameters
        ----------
        names, units : names of the channels, and their units in the file
        stored : samples of the `parts`, shape (time,) each
        origin : date of the origin of the channels, ISO 8601; empty where it is unknown
        remarks : remarks on the file
        further : fields of `Recorded`
        """
        return Recorded(
            names=names,
            units=units,
            samples=self.on_grid(stored),
            sample_rate_hz=self.rate_hz,
            start_time=self.later(origin),
            first_sample=self.first,
            total_samples=self.total,
            line=self.key,
            remarks=[*remarks, *self.remarks(units, stored)],
            **further,
        )

    def later(self, start_time: str) -> str:
        """Start time of the line, ISO 8601, from that of the origin; what is no date stays."""
        try:
            start = datetime.fromisoformat(start_time) + timedelta(seconds=self.start_s)
        except (ValueError, OverflowError):
            return start_time
        return start.isoformat() if abs(self.start_s) >= 1e-6 else start_time

    def _position(self, time: ChannelTime, sample: Array | float) -> Array:
        """Position of samples of the line among those of a channel, in its intervals."""
        start = (self.start_s - time.start_s) * time.rate_hz
        return np.asarray(start + np.asarray(sample) * (time.rate_hz / self.rate_hz))

    def _is_shifted(self, time: ChannelTime) -> bool:
        """Whether no sample of a channel of the same rate is at a time of the line."""
        start = float(self._position(time, 0.0))
        return abs(start - round(start)) > LEAST_SHIFT

    def _is_even_copy(self, time: ChannelTime) -> bool:
        same = _same_rate(time, self.rate_hz)
        return time.uneven_s is None and same and not self._is_shifted(time)

    def _part(self, time: ChannelTime) -> tuple[int, int]:
        if self._is_even_copy(time):
            start = round(float(self._position(time, 0.0)))
            return start + self.first, start + self.last
        if time.uneven_s is not None:
            return 0, time.samples
        first, last = self._position(time, np.array([self.first, max(self.first, self.last - 1)]))
        room = 4 if _is_slow(time, self.rate_hz) else HALF_LENGTH
        return max(floor(first) - room, 0), min(ceil(last) + room + 1, time.samples)

    def _resampled(self, time: ChannelTime, part: tuple[int, int], samples: Samples) -> Samples:
        if self._is_even_copy(time):
            return samples
        wanted = np.arange(self.first, self.last, dtype=float)
        values = samples.astype(float)
        check_finite(time.name, values)
        if time.uneven_s is not None:
            return spline(time.uneven_s, values, self.start_s + wanted / self.rate_hz)
        position = self._position(time, wanted) - part[0]
        if _is_slow(time, self.rate_hz):
            return cubic(values, np.clip(position, 0.0, values.size - 1.0))
        return band_limited(values, position)

    def _cut(self) -> list[str]:
        """A line where the channels do not share all of their time."""
        starts, ends = [time.start_s for time in self.times], [time.end_s for time in self.times]
        end_s = self.start_s + (self.total - 1) / self.rate_hz
        cut_s = max(self.start_s - min(starts), max(ends) - end_s)
        if cut_s < 0.5 / self.rate_hz:
            return []
        return [
            f"its channels start and end at different times, {min(starts):.6g} s to "
            f"{max(ends):.6g} s: the part that all have is read, {self.start_s:.6g} s to "
            f"{end_s:.6g} s"
        ]

    def _interpolated(
        self, time: ChannelTime, unit: str, first: int, samples: Samples
    ) -> list[str]:
        """Lines on how a channel is brought to the line."""
        if self._is_even_copy(time):
            return []
        full = overload(samples)
        is_usual = full is None or may_be_full(unit, full.between)
        lines = [] if full is None or is_usual or _is_slow(time, self.rate_hz) else [
            f"channel {time.name!r}: {full.samples} samples are at full scale before the "
            "interpolation: the recorder may have been overloaded"
        ]  # fmt: skip
        if time.uneven_s is None and not _is_slow(time, self.rate_hz):
            start = float(self._position(time, 0.0))
            how = (
                f"starts {start - round(start):.3g} sampling intervals off the others"
                if _same_rate(time, self.rate_hz)
                else f"has {time.rate_hz:.9g} Hz, the fastest {self.rate_hz:.9g} Hz"
            )
            return [*lines, f"channel {time.name!r}: {how}: band-limited interpolation"]
        values = samples[:_MOST_PREDICTED].astype(float)
        seconds = np.arange(values.size) / time.rate_hz
        if time.uneven_s is not None:
            seconds = time.uneven_s[: values.size]
        kind = "uneven times" if time.uneven_s is not None else "samples"
        line = (
            f"channel {time.name!r}: {kind} of {time.rate_hz:.6g} Hz are interpolated to "
            f"{self.rate_hz:.6g} Hz"
        )
        if self.first == self.last:  # samples are read in blocks later
            return [*lines, line]
        error = f"{prediction_error(seconds, values):.2g} {unit}".rstrip()
        return [*lines, f"{line}: every second sample is predicted from the others: {error} RMS"]


def time_line(times: Sequence[ChannelTime], request: Request) -> TimeLine:
    """Time line that channels share, and the part of it that is wanted.

    Its samples are those of the first channel of the fastest rate.

    Raises
    ------
    ParameterError
        There is no channel, or no time at which all have samples; the part is empty.
    """
    if not times:
        raise ParameterError("no channel is chosen")
    rate_hz, start_s, total = request.line or _common(times)
    first, last = request.part(total, rate_hz)
    return TimeLine(times, rate_hz, start_s, total, first, last, request.is_block)


def _common(times: Sequence[ChannelTime]) -> tuple[float, float, int]:
    """Rate, start and number of samples of the part that all channels have."""
    rate_hz = max(time.rate_hz for time in times)
    check_rate(rate_hz)
    master = next(time for time in times if _same_rate(time, rate_hz))
    rate_hz = master.rate_hz
    line = TimeLine(times, rate_hz, master.start_s, 0, 0, 0, False)
    bounds = [_bounds(line, time) for time in times]
    begin = ceil(max(first for first, _ in bounds) * rate_hz - LEAST_SHIFT)
    end = floor(min(last for _, last in bounds) * rate_hz + LEAST_SHIFT) + 1
    total = end - begin
    if total < MINIMUM_SAMPLES:
        spans = [f"{t.name} {t.start_s:.6g} s to {t.end_s:.6g} s" for t in times]
        raise ParameterError(
            f"channels have no common time ({listed(spans)}): choose channels that do"
        )
    return rate_hz, master.start_s + begin / rate_hz, total


def _bounds(line: TimeLine, time: ChannelTime) -> tuple[float, float]:
    """First and last time after the start of a line at which a channel has values, s."""
    start, end = time.start_s - line.start_s, time.end_s - line.start_s
    is_kernel = not line._is_even_copy(time) and time.uneven_s is None
    if is_kernel and not _is_slow(time, line.rate_hz):
        room_s = HALF_LENGTH / time.rate_hz
        return start + room_s, end - room_s
    return start, end


def _same_rate(time: ChannelTime, rate_hz: float) -> bool:
    return abs(time.rate_hz / rate_hz - 1.0) * time.samples < _SAME_RATE


def _is_slow(time: ChannelTime, rate_hz: float) -> bool:
    return time.rate_hz * _SLOW * (1.0 + 1e-9) < rate_hz
