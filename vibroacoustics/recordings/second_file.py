"""Channels of a second file, such as a tacho, on one time line with a recording.

Two recorders have two clocks. Where both files hold one signal, its segments fix start and rate of
the second clock; else the start times that the files state give the start, and the rates are
unknown.
"""

from datetime import datetime
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import scipy  # loads its subpackages when they are needed
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.recording_blocks import RecordingBlocks
from .blocks import FileBlocks, LabelledBlocks
from .reading import read_recording
from .recorded import MissingError, Request, listed
from .recording import label_in_place
from .remarks import remark
from .time_line import ChannelTime, time_line

_SEGMENTS: Final = 8
"""Segments of a signal that are looked for in the other file."""
_LIKE: Final = 0.9
"""Least correlation of a segment with its copy."""
_RIVAL: Final = 0.97
"""Largest correlation elsewhere, over that of the copy: of a steady tone all periods are alike."""
_NEAR_S: Final = 0.02
"""Time within which correlations belong to one copy."""
_MOST_DRIFT: Final = 1e-3
"""Largest difference between the rates of two clocks; quartz has below 1e-4."""
_SAMPLES: Final = 2**21
"""Samples of a signal that are compared; of longer ones every n-th is taken."""


class SpeedFile(NamedTuple):
    """Second file with channels of the speed.

    Attributes
    ----------
    path : the file
    channels : names of its channels that are wanted
    """

    path: Path
    channels: tuple[str, ...]

    def name_of(self, channel: str) -> str:
        """Return the name of one of its channels beside those of a recording."""
        return f"{self.path.name} {channel}"


class Clock(NamedTuple):
    """Clock of a second file beside that of a recording.

    Attributes
    ----------
    start_s : time of its first sample, s from the first one of the recording
    drift : seconds by which it is slow in each second
    note : sentence on how both are known
    """

    start_s: float
    drift: float
    note: str


def with_second_file(recording: xr.Dataset, file: SpeedFile) -> xr.Dataset:
    """Recording with channels of a second file, named `FILE CHANNEL`, on their common time.

    Parameters
    ----------
    recording : from `read_recording`
    file : second file; where it states no unit or calibration its samples are taken as V

    Raises
    ------
    ParameterError, StorageError
        See `read_recording`; or the files have no common time.

    Warns
    -----
    RecordingWarning
        Says how the clocks of both files are brought together.
    """
    path, channels = file
    second = _read(path)
    names = [str(name) for name in second["channel"].values]
    for name in channels:
        if name not in names:
            raise ParameterError(f"{path}: no channel {name!r} among {listed(names)}")
    clock = clock_of(recording, second)
    chosen = second.sel(channel=list(channels))
    renamed = [file.name_of(name) for name in channels]
    names = [*map(str, recording["channel"].values), *renamed]
    clocks = [(recording, 0.0, 0.0), (chosen, clock.start_s, clock.drift)]
    starts = [(part, start_s, drift) for part, start_s, drift in clocks for _ in part["channel"]]
    times = [
        ChannelTime(name, part.sizes["time"], part.attrs["sample_rate_hz"] / (1.0 + drift), start_s)
        for name, (part, start_s, drift) in zip(names, starts, strict=True)
    ]
    line = time_line(times, Request(path))
    rows = [row for part, _, _ in clocks for row in part["signal"].values]
    stored = [row[slice(*part)] for row, part in zip(rows, line.parts, strict=True)]
    units = [str(unit) for part, _, _ in clocks for unit in part["channel_unit"].values]
    joined = label_in_place(np.array(line.on_grid(stored)), line.rate_hz, names, units, {})
    factors = np.concatenate([part["calibration_factor"].values for part, _, _ in clocks])
    joined = joined.assign_coords(calibration_factor=("channel", factors))
    remarks = [clock.note, *line.remarks(units, stored)]
    remark(path, remarks)
    before = recording.attrs.get("reading_remarks")
    texts = [*([before] if before else []), *(f"{path.name}: {each}" for each in remarks)]
    joined.attrs = recording.attrs | {
        "sample_rate_hz": line.rate_hz,
        "reading_remarks": "; ".join(texts),
        "speed_file": path.name,
        "speed_file_sha256": second.attrs["source_sha256"],
    }
    if line.start_s > 0.0:
        joined.attrs["part_start_s"] = recording.attrs.get("part_start_s", 0.0) + line.start_s
    return joined


def blocks_with_speed(sound: FileBlocks, file: SpeedFile | None) -> RecordingBlocks:
    """Recording from its file, with the channels of the speed that a second file has, if any."""
    if file is None:
        return sound
    samples, units = sound.read(sound.channels, 0, sound.samples), sound.channel_units
    recording = label_in_place(samples, sound.sample_rate_hz, sound.channels, units, {})
    factors = ("channel", list(sound.calibration_factors))
    recording = recording.assign_coords(calibration_factor=factors)
    recording.attrs = dict(sound.attributes)
    return LabelledBlocks(with_second_file(recording, file))


def _read(path: Path) -> xr.Dataset:
    """Second file; pulses need neither unit nor calibration."""
    try:
        return read_recording(path)
    except MissingError:
        return read_recording(path, units={"*": "V"}, calibration={"*": 1.0})


def clock_of(recording: xr.Dataset, second: xr.Dataset) -> Clock:
    """Clock of a second recording: by a signal that both have, else by the stated start times."""
    units = [dict(zip(each["channel"].values, each["channel_unit"].values, strict=True))
             for each in (recording, second)]  # fmt: skip
    for name in units[0].keys() & units[1].keys():
        signals = [each["signal"].sel(channel=name).values for each in (recording, second)]
        rates = [float(each.attrs["sample_rate_hz"]) for each in (recording, second)]
        clock = shared_clock(str(name), signals[0], rates[0], signals[1], rates[1])
        if clock is not None:
            return clock
    starts = [_start(each) for each in (recording, second)]
    unknown = "how far both clocks are apart and drift is unknown"
    if starts[0] is not None and starts[1] is not None and not _differ(starts[0], starts[1]):
        start_s = (starts[1] - starts[0]).total_seconds()
        for sign, each in ((1.0, second), (-1.0, recording)):
            start_s += sign * float(each.attrs.get("part_start_s", 0.0))
        return Clock(
            start_s, 0.0, f"starts {start_s:.6g} s behind the recording, as both files state: "
            f"{unknown}"
        )  # fmt: skip
    return Clock(
        0.0,
        0.0,
        f"its first sample is taken as that of the recording, no start is known: {unknown}",
    )


def _start(recording: xr.Dataset) -> datetime | None:
    try:
        return datetime.fromisoformat(str(recording.attrs.get("start_time", "")))
    except ValueError:
        return None


def _differ(first: datetime, second: datetime) -> bool:
    """Whether one of two times has a zone alone."""
    return (first.tzinfo is None) != (second.tzinfo is None)


def shared_clock(
    name: str, signal: Array, rate_hz: float, other: Array, other_rate_hz: float
) -> Clock | None:
    """Clock of a signal that is a copy of another, from the lags of its segments.

    The correlation of a segment with the signal, each over its energy, has its highest value at
    the lag (Knapp and Carter 1976, IEEE Transactions on Acoustics, Speech, and Signal Processing
    24, without weights); a line through the lags is the clock.

    Parameters
    ----------
    name : name of the channel
    signal, rate_hz : samples of the recording, shape (time,), and its sample rate
    other, other_rate_hz : samples of the second file, shape (time,), and its sample rate

    Returns
    -------
    None where they are no copies or a steady tone leaves several lags
    """
    step = max(signal.size // _SAMPLES, 1)
    coarse_hz = rate_hz / step
    signal = signal[::step] - signal.mean()
    position = np.arange(int((other.size - 1) / other_rate_hz * coarse_hz)) / coarse_hz
    other = np.interp(position * other_rate_hz, np.arange(other.size), other - other.mean())
    length = min(other.size, signal.size) // (2 * _SEGMENTS)
    if length < 2 * _SEGMENTS:
        return None
    firsts = np.linspace(0, other.size - length, 2 * _SEGMENTS).astype(int)
    located = [(first, _lag(signal, other[first : first + length], coarse_hz)) for first in firsts]
    middle = 0.5 * length  # of a segment, to which its lag belongs
    times = np.array([(first + middle) / coarse_hz for first, lag in located if lag is not None])
    lags = np.array([lag - first / coarse_hz for first, lag in located if lag is not None])
    if times.size < _SEGMENTS:
        return None
    drift, start_s = np.polyfit(times, lags, 1)
    scatter_s = float(np.std(lags - start_s - drift * times))
    if abs(drift) > _MOST_DRIFT or scatter_s > 1.0 / min(coarse_hz, other_rate_hz):
        return None
    return Clock(
        float(start_s),
        float(drift),
        f"starts {start_s:.6g} s behind the recording and its clock drifts by {1e6 * drift:.3g} "
        f"ppm, by channel {name!r} of both, within {scatter_s:.2g} s: corrected",
    )


def _lag(signal: Array, segment: Array, rate_hz: float) -> float | None:
    """Time in a signal at which a segment starts, s; None where no single place is like it."""
    if not segment.any() or segment.size > signal.size:
        return None
    product = scipy.signal.correlate(signal, segment, mode="valid", method="fft")
    square = np.concatenate([[0.0], np.cumsum(signal**2)])
    energy = square[segment.size :] - square[: -segment.size]
    likeness = product / np.sqrt(np.maximum(energy, 1e-12 * square[-1]) * np.sum(segment**2))
    best = int(np.argmax(likeness))
    near = np.abs(np.arange(likeness.size) - best) < _NEAR_S * rate_hz
    rival = float(likeness[~near].max(initial=0.0))
    if likeness[best] < _LIKE or rival > _RIVAL * likeness[best]:
        return None
    shift = 0.0
    if 0 < best < likeness.size - 1:  # vertex of the parabola through three values
        before, middle, behind = likeness[best - 1 : best + 2]
        shift = 0.5 * (before - behind) / min(before - 2.0 * middle + behind, -1e-30)
    return float(best + shift) / rate_hz
