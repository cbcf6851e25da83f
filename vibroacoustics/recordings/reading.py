"""A recording from a file of any format, in the labelled form."""

import io
import json
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, cast

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError, PluginError, StorageError, VibroacousticsError
from .child import MAXIMUM_CPU_S
from .reader import readers_by_suffix
from .recorded import MAXIMUM_READING_BYTES, check_rate, listed
from .recording import label_in_place

_ERRORS: Final = {error.__name__: error for error in (ParameterError, PluginError, StorageError)}


def read_recording(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    calibration: Mapping[str, float] | None = None,
    channels: Sequence[str] | None = None,
    sample_rate_hz: float | None = None,
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

    Returns
    -------
    `signal` (channel, time) in SI units, with the coordinates `channel_unit` and
    `calibration_factor` and the attributes `sample_rate_hz`, `source_file`, `source_sha256` and,
    where known, `start_time`

    Raises
    ------
    ParameterError
        A unit, a calibration factor or the sample rate is missing or unusable, a channel is not
        in the file, samples are not finite or times not even.
    StorageError
        The file is missing, damaged, or larger than the caps.

    Examples
    --------
    >>> recording = va.label_recording([[0.0, 0.5]], 1000.0, ["front"], ["Pa"])
    >>> file = va.export_recording(recording, "front.csv")
    >>> va.read_recording(file)["signal"].sel(channel="front").values
    array([0. , 0.5])
    """
    path = Path(path)
    try:
        readers = readers_by_suffix()
        check_file(path, list(readers))
        plugin = readers[path.suffix.lower()].plugin
        if sample_rate_hz is not None:
            check_rate(sample_rate_hz)
        header, stored = read_in_child(
            {
                "path": str(path),
                "channels": None if channels is None else list(channels),
                "sample_rate_hz": None if sample_rate_hz is None else float(sample_rate_hz),
                "plugin": None if plugin is None else str(plugin),
            }
        )
        recording = label_in_place(
            stored,
            header["sample_rate_hz"],
            header["names"],
            _units(header, units or {}, calibration or {}),
            calibration or {},
        )
    except VibroacousticsError as error:
        raise type(error)(f"{path}: {error}") from None
    recording.attrs |= {"source_file": path.name, "source_sha256": header["sha256"]}
    if header["start_time"]:
        recording.attrs["start_time"] = header["start_time"]
    return recording


def check_file(path: Path, suffixes: Sequence[str]) -> None:
    """Refuse a file that is missing, empty, too large, or of another kind.

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
    if size > MAXIMUM_READING_BYTES:
        raise StorageError(
            f"has {size / 2**30:.3g} GiB; at most {MAXIMUM_READING_BYTES / 2**30:g} GiB"
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
    complete = stream.readinto(samples.data.cast("B")) == samples.nbytes
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
    header: Mapping[str, Any], units: Mapping[str, str], calibration: Mapping[str, float]
) -> list[str]:
    """Unit of each channel, from the user or else from the file."""
    names = header["names"]
    for option, given in (("units", units), ("calibration", calibration)):
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
