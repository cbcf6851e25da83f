"""A recording from a file of any format, in the labelled form."""

import hashlib
import io
import json
import signal
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, cast

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError, PluginError, StorageError, VibroacousticsError
from .child import MAXIMUM_CPU_S
from .reader import readers_by_suffix
from .recorded import MAXIMUM_READING_BYTES, check_part, check_rate, listed
from .recording import label_in_place

_ERRORS: Final = {error.__name__: error for error in (ParameterError, PluginError, StorageError)}


def read_recording(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    calibration: Mapping[str, float] | None = None,
    channels: Sequence[str] | None = None,
    sample_rate_hz: float | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
) -> xr.Dataset:
    """Read a recording; what its file must hold is told in docs/recordings.md.

    The file is read in a process of its own, of limited memory.

    Parameters
    ----------
    path : WAV, MAT, CSV, HDF5, netCDF, UFF or TDMS file, or one that a plug-in reads
    units : unit by channel; it overrides the file's, and is needed where the file states none
    calibration : factor by channel, the channel's unit per unit stored in the file
    channels : names of the channels to read; default: all
    sample_rate_hz : actual sample rate, where the file states none or a rounded one
    from_s, to_s : part to read, in seconds from the first sample; default: all

    Returns
    -------
    `signal` (channel, time) in SI units, with the coordinates `channel_unit` and
    `calibration_factor` and the attributes `sample_rate_hz`, `source_file`, `source_sha256` and,
    where known, `start_time`; of a part `part_start_s`, and `part_sha256` of its samples instead
    of the file's hash where the file is larger than the cap; `reading_remarks` where there are
    warnings

    Raises
    ------
    ParameterError
        A unit, a calibration factor or the sample rate is missing or unusable, a channel is not
        in the file, samples are not finite or times not even.
    StorageError
        The file is missing, damaged, or larger than the caps.

    Warns
    -----
    RecordingWarning
        Samples are at full scale, or the file's end is missing.

    Examples
    --------
    >>> recording = va.label_recording([[0.0, 0.5]], 1000.0, ["front"], ["Pa"])
    >>> file = va.export_recording(recording, "front.csv")
    >>> va.read_recording(file)["signal"].sel(channel="front").values
    array([0. , 0.5])
    """
    asked = Asked(Path(path), units or {}, calibration or {}, channels, sample_rate_hz)
    with naming_file(asked.path):
        check_part(from_s, to_s)
        is_part = from_s is not None or to_s is not None
        is_large = asked.check(may_be_large=is_part or channels is not None)
        part = {"from_s": from_s, "to_s": to_s, "hashed": not is_large}
        header, stored = read_in_child(asked.request() | part)
        digest = {"source_sha256": header["sha256"]}
        if is_large:
            digest = {"part_sha256": hashlib.sha256(stored.data.cast("B")).hexdigest()}
        recording = label_in_place(
            stored,
            header["sample_rate_hz"],
            header["names"],
            asked.chosen_units(header),
            asked.chosen_calibration(header),
        )
    _warn(recording, asked.path, header)
    recording.attrs |= {"source_file": asked.path.name, **digest}
    if is_part:
        recording.attrs["part_start_s"] = header["first_sample"] / header["sample_rate_hz"]
    if header["start_time"]:
        recording.attrs["start_time"] = header["start_time"]
    return recording


_NEVER_OVERLOADED: Final = ("rpm", "rad/s", "rad", "1")
"""Units of channels that stay at one value, or jump from one to another."""


class RecordingWarning(UserWarning):
    """A recording was read, but its file holds something that its user must know."""


@dataclass(frozen=True)
class Asked:
    """What is asked of a file: how its channels are to be read, in the user's words.

    Attributes
    ----------
    path : of the file
    units, calibration, channels, sample_rate_hz : as in `read_recording`
    """

    path: Path
    units: Mapping[str, str]
    calibration: Mapping[str, float]
    channels: Sequence[str] | None
    sample_rate_hz: float | None

    def check(self, may_be_large: bool) -> bool:
        """Refuse a file that cannot be read; see `check_file`. Whether it is above the cap."""
        check_file(self.path, list(readers_by_suffix()), may_be_large)
        if self.sample_rate_hz is not None:
            check_rate(self.sample_rate_hz)
        return self.path.stat().st_size > MAXIMUM_READING_BYTES

    def request(self) -> dict[str, Any]:
        """The request to the process that reads."""
        plugin = readers_by_suffix()[self.path.suffix.lower()].plugin
        return {
            "path": str(self.path),
            "channels": None if self.channels is None else list(self.channels),
            "sample_rate_hz": None if self.sample_rate_hz is None else float(self.sample_rate_hz),
            "plugin": None if plugin is None else str(plugin),
        }

    def chosen_units(self, header: Mapping[str, Any]) -> list[str]:
        """Unit of each channel, from the user or else from the file."""
        return _units(header, self.units, self.chosen_calibration(header), self.calibration)

    def chosen_calibration(self, header: Mapping[str, Any]) -> dict[str, float]:
        """Factor by channel, from the user or else from the file, in the file's unit."""
        stated = zip(header["names"], header["units"], header["calibration"], strict=True)
        of_file = {
            name: factor
            for name, unit, factor in stated
            if factor is not None and self.units.get(name, unit) == unit
        }
        return of_file | dict(self.calibration)


@contextmanager
def naming_file(path: Path) -> Iterator[None]:
    """Put the file before what goes wrong with it."""
    try:
        yield
    except VibroacousticsError as error:
        raise type(error)(f"{path}: {error}") from None


def _warn(recording: xr.Dataset, path: Path, header: Mapping[str, Any]) -> None:
    """Tell what the user must know, and keep it with the recording."""
    lines = [*header["remarks"], *_overloads(recording, header)]
    for line in lines:
        warnings.warn(f"{path}: {line}", RecordingWarning, stacklevel=3)
    if lines:
        recording.attrs["reading_remarks"] = "; ".join(lines)


def _overloads(recording: xr.Dataset, header: Mapping[str, Any]) -> Iterator[str]:
    """A line for each channel with samples at full scale."""
    for name, unit, overload in zip(
        header["names"], recording["channel_unit"].values, header["overloads"], strict=True
    ):
        if overload is None or str(unit) in _NEVER_OVERLOADED:
            continue
        time_s = (header["first_sample"] + overload["first"]) / header["sample_rate_hz"]
        yield (
            f"channel {name!r}: {overload['samples']} samples are at full scale, the first at "
            f"{time_s:.9g} s: the recorder may have been overloaded"
        )


def check_file(path: Path, suffixes: Sequence[str], may_be_large: bool = False) -> None:
    """Refuse a file that is missing, empty, too large, or of another kind.

    Parameters
    ----------
    path : of the file
    suffixes : that are known
    may_be_large : whether only a part of it is read

    Raises
    ------
    ParameterError
        Its name ends otherwise.
    StorageError
        There is no such file, or it is empty or too large.
    """
    if path.suffix.lower() not in suffixes:
        raise ParameterError(f"format {path.suffix!r} is unknown; known are {', '.join(suffixes)}")
    try:
        size = path.stat().st_size
    except FileNotFoundError:
        raise StorageError("no such file") from None
    except (OSError, ValueError) as error:  # ValueError: a name with a null byte
        raise StorageError(f"cannot be read: {error}") from None
    if not path.is_file():
        raise StorageError("is no file")
    if size == 0:
        raise StorageError("is empty")
    if size > MAXIMUM_READING_BYTES and not may_be_large:
        raise StorageError(
            f"has {size / 2**30:.3g} GiB; at most {MAXIMUM_READING_BYTES / 2**30:g} GiB are read "
            "at once: give from_s and to_s, or channels"
        )


def read_in_child(request: Mapping[str, Any]) -> tuple[dict[str, Any], Array]:
    """Header and samples, shape (channel, time), that the child hands over.

    Raises
    ------
    ParameterError, StorageError
        What the child found wrong, or that it crashed.
    """
    # -P: no module beside the recording, such as a numpy.py, is ever run.
    command = [sys.executable, "-P", "-m", f"{__package__}.child", json.dumps(request)]
    with (
        tempfile.TemporaryFile() as messages,
        subprocess.Popen(  # noqa: S603 - our own module
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=messages
        ) as child,
    ):
        try:
            handed_over = _receive(cast(io.BufferedReader, child.stdout))
        except BaseException:  # a signal: the child may have much to read yet
            child.kill()
            raise
        if handed_over is None:
            messages.seek(0)
            raise StorageError(_end_of(child.wait(), messages.read()))
    return handed_over


def _receive(stream: io.BufferedReader) -> tuple[dict[str, Any], Array] | None:
    """What the child writes; None where it ended before all was written."""
    line = stream.readline()
    if not line.endswith(b"\n"):
        return None
    header = json.loads(line)
    if "error" in header:
        raise _ERRORS[header["error"]](header["message"])
    samples = np.empty((len(header["names"]), header["samples"]))
    complete = not samples.size or stream.readinto(samples.data.cast("B")) == samples.nbytes
    return (header, samples) if complete else None


def _end_of(code: int, messages: bytes) -> str:
    """What to tell of a child that ended early."""
    if code == -signal.SIGXCPU:
        return f"was not read after {MAXIMUM_CPU_S} s: the file is damaged or too large"
    if code < 0:
        return f"the parser crashed ({signal.Signals(-code).name}): the file is damaged"
    last = messages.decode("utf-8", "replace").strip().splitlines()[-1:]
    return f"the process that reads it failed: {''.join(last)}"


def _units(
    header: Mapping[str, Any],
    units: Mapping[str, str],
    calibration: Mapping[str, float],
    given_calibration: Mapping[str, float],
) -> list[str]:
    """Unit of each channel, from the user or else from the file."""
    names = header["names"]
    for option, given in (("units", units), ("calibration", given_calibration)):
        for name in given:
            if name not in names:
                raise ParameterError(f"{option}: no channel {name!r} among {listed(names)}")
    if header["full_scale"]:
        _check_calibrated(names, calibration)
    chosen = [units.get(name, stated) for name, stated in zip(names, header["units"], strict=True)]
    missing = [name for name, unit in zip(names, chosen, strict=True) if not unit]
    if missing:
        raise ParameterError(
            f"the file states no unit for {listed(missing)}: give it, as in "
            f"units={{{missing[0]!r}: 'Pa'}}"
        )
    return chosen


def _check_calibrated(names: Sequence[str], calibration: Mapping[str, float]) -> None:
    missing = [name for name in names if name not in calibration]
    if missing:
        raise ParameterError(
            f"samples of {listed(missing)} are fractions of full scale: give the calibration "
            f"factor, unit at full scale, as in calibration={{{missing[0]!r}: 20.0}}"
        )
