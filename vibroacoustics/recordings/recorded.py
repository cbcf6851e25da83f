"""Request to a reader of one format and its answer, with the checks they share."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..base.allowed import check_range
from ..base.errors import ParameterError, StorageError
from .quantities import find_quantity

Samples = NDArray[Any]


class TooLargeError(StorageError):
    """A recording is larger than is read at once; `open_recording` may still read it in blocks."""


class MissingError(ParameterError):
    """The file lacks something that the user must give; what else is missing is asked for too."""


MAXIMUM_RECORDING_BYTES: Final = 2 * 2**30
"""Largest recording: samples of all channels and the time axis, 8 bytes each."""
MAXIMUM_READING_BYTES: Final = 2 * MAXIMUM_RECORDING_BYTES
"""Largest file, and all the memory that the process which reads it may ask for: the recording and
as much again for the form in which the file holds it."""
MINIMUM_SAMPLES: Final = 2
SAMPLE_RATES_HZ: Final = (1e-3, 1e9)
"""Sample rates, from one sample in a quarter of an hour to the fastest digitisers."""
_LONGEST_S: Final = 1e9
"""Latest time in a recording: 30 years."""


@dataclass(frozen=True)
class Request:
    """Request: the file, some of its channels, a sample rate that overrides the file's; or
    the modes of a structure.

    Attributes
    ----------
    path : path of the file
    channels : wanted; None for all
    sample_rate_hz : that overrides the file's; None where the file's holds
    modes : whether modes are read, no recording
    from_s, to_s : part that is wanted, seconds from the first sample; None for begin and end
    samples : part that is wanted, first sample and the one behind the last; instead of times
    opening : times of the part that is read in blocks later; None unless the header alone is wanted
    units : names of channels whose unit the user states; `*` for all
    line : rate, start and samples of the time line of an opened recording, of which a block has
        some of the channels; None where each channel has its samples

    Examples
    --------
    >>> from pathlib import Path
    >>> va.Request(Path("run.log16"), channels=("b",)).chosen(["a", "b"])
    [1]
    >>> va.Request(Path("run.log16"), from_s=2.0).part(300, sample_rate_hz=100.0)
    (200, 300)
    """

    path: Path
    channels: tuple[str, ...] | None = None
    sample_rate_hz: float | None = None
    modes: bool = False
    from_s: float | None = None
    to_s: float | None = None
    samples: tuple[int, int] | None = None
    opening: tuple[float | None, float | None] | None = None
    units: tuple[str, ...] = ()
    line: tuple[float, float, int] | None = None

    @property
    def is_block(self) -> bool:
        """Whether a block of an opened recording is read, on which nothing is remarked."""
        return self.samples is not None and self.opening is None

    def planned(self, samples: int, sample_rate_hz: float) -> tuple[int, int]:
        """Part that is read now or, of a file that is opened, in blocks later; see `part`."""
        if self.opening is None:
            return self.part(samples, sample_rate_hz)
        from_s, to_s = self.opening
        part = replace(self, samples=None, from_s=from_s, to_s=to_s)
        return part.part(samples, sample_rate_hz)

    @property
    def every(self) -> "Request":
        """All of the recording, for what is read in full and cut later."""
        return Request(self.path, sample_rate_hz=self.sample_rate_hz, line=self.line)

    @property
    def wants_all(self) -> bool:
        """Whether no part is asked for."""
        return self.from_s is None and self.to_s is None and self.samples is None

    def part(self, samples: int, sample_rate_hz: float) -> tuple[int, int]:
        """First sample that is wanted, and the one behind the last.

        Parameters
        ----------
        samples : that the file holds of a channel
        sample_rate_hz : actual sample rate

        Raises
        ------
        ParameterError
            The part begins behind the end of the recording, or is empty.
        """
        if self.samples is not None:
            return max(self.samples[0], 0), min(self.samples[1], samples)
        first = 0 if self.from_s is None else _nearest_sample(self.from_s, sample_rate_hz)
        last = samples
        if self.to_s is not None:
            last = min(samples, _nearest_sample(self.to_s, sample_rate_hz))
        if last - first < MINIMUM_SAMPLES:
            raise ParameterError(
                f"from_s = {self.from_s or 0.0:g} s, to_s = "
                f"{samples / sample_rate_hz if self.to_s is None else self.to_s:g} s: holds no "
                f"samples; the recording lasts {samples / sample_rate_hz:.9g} s"
            )
        return first, last

    def chosen(self, names: Sequence[str], units: Sequence[str] = ()) -> list[int]:
        """Places of the wanted channels among those of the file, in the order asked for.

        Where none are named, those of unknown unit are omitted, unless all are.

        Parameters
        ----------
        names, units : names of the channels of the file, and their units

        Raises
        ------
        ParameterError
            The file has no channel of that name, or several.
        """
        if self.channels is None:
            unknown = self._unknown(names, units)
            return [index for index in range(len(names)) if index not in unknown]
        for name in self.channels:
            if names.count(name) != 1:
                how_often = "not in the file" if name not in names else "more than once in the file"
                raise ParameterError(f"channel {name!r}: {how_often}, which holds {listed(names)}")
        return [names.index(name) for name in self.channels]

    def omissions(self, names: Sequence[str], units: Sequence[str]) -> list[str]:
        """Remarks on the channels that `chosen` omits."""
        if self.channels is not None:
            return []
        return [
            f"channel {names[index]!r} is omitted: its unit {units[index]!r} is unknown; give "
            "units or channels to read it"
            for index in self._unknown(names, units)
        ]

    def _unknown(self, names: Sequence[str], units: Sequence[str]) -> list[int]:
        """Places of channels of unknown unit, none where all are."""
        if "*" in self.units:
            return []
        unknown = [
            index
            for index, (name, unit) in enumerate(zip(names, units, strict=False))
            if unit and name not in self.units and find_quantity(unit) is None
        ]
        return unknown if len(unknown) < len(names) else []


@dataclass(frozen=True)
class Recorded:
    """Channels of a file as the file holds them, not yet in SI.

    Attributes
    ----------
    names : names of the channels
    units : units in the file; empty where it states none
    samples : one array a channel, shape (time,)
    sample_rate_hz : actual sample rate
    start_time : ISO 8601; empty where it is unknown
    full_scale : whether the samples are fractions of the recorder's full scale
    first_sample : number of the first sample that is handed back, where the reader has read the
        part that was asked for; None where it has read all
    total_samples : that the file holds of a channel; None for as many as are handed back
    limits : lowest and highest value that the file's number format can hold, one pair a channel;
        a sample at a limit is an overload. Empty where the format has none
    calibration : factor that the file states of each channel, its unit per unit of the samples;
        one that the user gives counts instead. Empty or None where the file states none
    counts : words on samples that are counts without a factor, one a channel, empty where they are
        values; a calibration must be given for them
    line : see `Request`
    remarks : remarks on the file for the user, a line each

    Examples
    --------
    >>> va.Recorded(["sensor"], ["V"], [np.zeros(4)], 25600.0).full_scale
    False
    """

    names: Sequence[str]
    units: Sequence[str]
    """Units in the file; empty where it states none."""
    samples: Sequence[Samples]
    """One array a channel."""
    sample_rate_hz: float
    start_time: str = ""
    full_scale: bool = False
    """The samples are fractions of the recorder's full scale and mean nothing uncalibrated."""
    first_sample: int | None = None
    total_samples: int | None = None
    limits: Sequence[tuple[float, float] | None] = ()
    calibration: Sequence[float | None] = ()
    counts: Sequence[str] = ()
    line: tuple[float, float, int] | None = None
    remarks: Sequence[str] = ()


def _nearest_sample(time_s: float, sample_rate_hz: float) -> int:
    return round(time_s * sample_rate_hz)


def check_part(from_s: float | None, to_s: float | None) -> None:
    """Refuse a part that is none.

    Raises
    ------
    ParameterError
        A time is out of range, or the end does not lie behind the begin.
    """
    for name, value in (("from_s", from_s), ("to_s", to_s)):
        if value is not None:
            check_range(name, value, 0.0, _LONGEST_S, "s")
    if to_s is not None and to_s <= (from_s or 0.0):
        raise ParameterError(f"to_s = {to_s:g} s: must lie behind from_s = {from_s or 0.0:g} s")


def check_size(channels: int, samples: int) -> None:
    """Refuse a recording by the size that its header claims, before anything is allocated.

    Raises
    ------
    TooLargeError
        The recording would be larger than the cap.
    """
    size = 8 * (channels + 1) * samples
    if size > MAXIMUM_RECORDING_BYTES:
        raise TooLargeError(
            f"{channels} channels of {samples} samples and their times take {size / 2**30:.3g} "
            f"GiB; at most {MAXIMUM_RECORDING_BYTES / 2**30:g} GiB are read at once: give from_s "
            "and to_s, or channels"
        )


def check_rate(sample_rate_hz: float) -> None:
    """Refuse a sample rate that no recorder has."""
    check_range("sample_rate_hz", sample_rate_hz, *SAMPLE_RATES_HZ, "Hz")


def numbered(names: Sequence[str]) -> list[str]:
    """The names, with a number behind those that occur more than once."""
    times = Counter(names)
    return [f"{name} {number}" if times[name] > 1 else name for number, name in enumerate(names, 1)]


def listed(names: Sequence[str], most: int = 12) -> str:
    """Names for a message, shortened where there are many."""
    shown = ", ".join(map(repr, names[:most]))
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown or "none"


_PIECE: Final = 2**22
"""Values that are read at once: few enough that the file's form takes little memory beside ours."""


def by_channel(
    read: Callable[[int, int], Samples], first: int, last: int, channels: int
) -> Samples:
    """Samples, shape (channel, time), each channel in one piece of memory.

    Parameters
    ----------
    read : samples from one time up to, but not with, another, shape (time, channel)
    first, last : samples that are wanted
    channels : that `read` gives
    """
    rows = max(1, _PIECE // max(1, channels))
    begin = read(first, min(first + rows, last))
    samples = np.empty((channels, last - first), begin.dtype)
    samples[:, : len(begin)] = begin.T
    for start in range(first + rows, last, rows):
        end = min(start + rows, last)
        samples[:, start - first : end - first] = read(start, end).T
    return samples
