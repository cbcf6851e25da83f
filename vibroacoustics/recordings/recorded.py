"""What a reader of one format is asked for and what it hands back, with the checks they share."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..base.errors import ParameterError, StorageError

Samples = NDArray[Any]

MAXIMUM_RECORDING_BYTES: Final = 2 * 2**30
"""Largest recording: samples of all channels and the time axis, 8 bytes each."""
MAXIMUM_READING_BYTES: Final = 2 * MAXIMUM_RECORDING_BYTES
"""Largest file, and all the memory that the process which reads it may ask for: the recording and
as much again for the form in which the file holds it."""
MINIMUM_SAMPLES: Final = 2
MAXIMUM_TIME_DEVIATION: Final = 0.05
"""Largest distance of a sample's time from the even grid, in sampling intervals: the rounding of
times written in microseconds at 100 kHz. More makes a phase error above 2° at a tenth of the
sample rate, if it is no rounding."""


@dataclass(frozen=True)
class Request:
    """What to read: the file, some of its channels, a sample rate that overrides the file's; or
    the modes of a structure.

    Attributes
    ----------
    path : of the file
    channels : wanted; None for all
    sample_rate_hz : that overrides the file's; None where the file's holds
    modes : whether modes are read, no recording

    Examples
    --------
    >>> from pathlib import Path
    >>> va.Request(Path("run.log16"), channels=("b",)).chosen(["a", "b"])
    [1]
    """

    path: Path
    channels: tuple[str, ...] | None = None
    sample_rate_hz: float | None = None
    modes: bool = False

    def chosen(self, names: Sequence[str]) -> list[int]:
        """Places of the wanted channels among those of the file, in the order asked for.

        Raises
        ------
        ParameterError
            The file has no channel of that name, or several.
        """
        if self.channels is None:
            return list(range(len(names)))
        for name in self.channels:
            if names.count(name) != 1:
                there = "not in the file" if name not in names else "more than once in the file"
                raise ParameterError(f"channel {name!r}: {there}, which holds {listed(names)}")
        return [names.index(name) for name in self.channels]


@dataclass(frozen=True)
class Recorded:
    """Channels of a file as the file holds them, not yet in SI.

    Attributes
    ----------
    names : of the channels
    units : as the file states them; empty where it states none
    samples : one array a channel, shape (time,)
    sample_rate_hz : actual sample rate
    start_time : ISO 8601; empty where it is unknown
    full_scale : whether the samples are fractions of the recorder's full scale

    Examples
    --------
    >>> va.Recorded(["sensor"], ["V"], [np.zeros(4)], 25600.0).full_scale
    False
    """

    names: Sequence[str]
    units: Sequence[str]
    """As the file states them; empty where it states none."""
    samples: Sequence[Samples]
    """One array a channel."""
    sample_rate_hz: float
    start_time: str = ""
    full_scale: bool = False
    """The samples are fractions of the recorder's full scale and mean nothing uncalibrated."""


def check_size(channels: int, samples: int) -> None:
    """Refuse a recording by the size that its header claims, before anything is allocated.

    Raises
    ------
    StorageError
        The recording would be larger than the cap.
    """
    size = 8 * (channels + 1) * samples
    if size > MAXIMUM_RECORDING_BYTES:
        raise StorageError(
            f"{channels} channels of {samples} samples and their times take {size / 2**30:.3g} "
            f"GiB; at most {MAXIMUM_RECORDING_BYTES / 2**30:g} GiB: choose fewer channels or a "
            "shorter part"
        )


def check_rate(sample_rate_hz: float) -> None:
    """Refuse a sample rate that is none.

    Raises
    ------
    ParameterError
        It is not above zero or not finite.
    """
    if not 0.0 < sample_rate_hz < np.inf:
        raise ParameterError(f"sample_rate_hz = {sample_rate_hz:g} Hz: must be above zero")


def even_rate_hz(time_s: Samples, request: Request) -> float:
    """Sample rate of a time axis, from its end points: (N - 1) / (t_N - t_1).

    Parameters
    ----------
    time_s : shape (time,), s
    request : its sample rate overrides that of the axis

    Raises
    ------
    ParameterError
        The times do not grow or are not even.
    """
    time = np.asarray(time_s, dtype=float)
    if time.size < MINIMUM_SAMPLES:
        raise ParameterError(f"time has {time.size} values; at least {MINIMUM_SAMPLES} are needed")
    wrong = np.flatnonzero(~(np.diff(time) > 0.0))  # not a number is wrong too
    if wrong.size:
        sample = int(wrong[0])
        raise ParameterError(
            f"time does not grow from sample {sample + 1} ({time[sample]:.9g} s) to the next "
            f"({time[sample + 1]:.9g} s)"
        )
    if request.sample_rate_hz is not None:
        return request.sample_rate_hz
    rate = float((time.size - 1) / (time[-1] - time[0]))
    deviation = np.abs((time - time[0]) * rate - np.arange(time.size))
    sample = int(np.argmax(deviation))
    if not deviation[sample] <= MAXIMUM_TIME_DEVIATION:
        raise ParameterError(
            f"time is not even: sample {sample + 1} lies {deviation[sample]:.3g} sampling "
            f"intervals off the grid of {rate:.9g} Hz, allowed are {MAXIMUM_TIME_DEVIATION:g}; "
            "if the times are only rounded, give sample_rate_hz"
        )
    return rate


def numbered(names: Sequence[str]) -> list[str]:
    """The names, with a number behind those that occur more than once."""
    times = Counter(names)
    return [f"{name} {number}" if times[name] > 1 else name for number, name in enumerate(names, 1)]


def listed(names: Sequence[str], most: int = 12) -> str:
    """Names for a message, shortened where there are many."""
    shown = ", ".join(map(repr, names[:most]))
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown or "none"
