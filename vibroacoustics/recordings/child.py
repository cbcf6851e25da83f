"""The process that reads one file: its memory and time are limited, and it may crash.

Parsers of binary formats ask for whatever a header claims, and the HDF5 library can crash on a
damaged file. So every file is read here, never in the process of the user.

On standard output: one line of JSON, then the samples, channel after channel: as float64, or where
they are asked for as the file stores them, in the type that the header names.
"""

import hashlib
import json
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np

from ..base.errors import ParameterError, StorageError, VibroacousticsError
from ..base.fault import FaultError
from ..base.plugin_file import load_plugin
from ..base.posix import resource
from . import uff_modes
from .extent import extents
from .overload import overloads
from .reader import READERS, Reader, needed, readers_by_suffix
from .recorded import MAXIMUM_READING_BYTES, MINIMUM_SAMPLES, Recorded, Request, check_size

MAXIMUM_CPU_S: Final = 600
PIECE: Final = 2**17
"""Samples that are handed over at a time, 1 MiB."""
_SMALL_TYPES: Final = ("<f4", "<i2", "<i4")
"""Types that take half the memory of float64 or less, and that it holds exactly."""


def answer(
    request: Request, plugin: str | None = None, hashed: bool = True
) -> tuple[dict[str, Any], Iterable[Any]]:
    """Header and channels of a file, or the error that the user shall see.

    Parameters
    ----------
    request : part of the file to read
    plugin : file of the user that brings the reader
    hashed : whether the file's hash is wanted
    """
    try:
        if plugin is not None:
            load_plugin(plugin)
        header, rows = (uff_modes.read if request.modes else _recording)(request)
        digest = _digest(request.path) if hashed else ""
    except VibroacousticsError as error:
        return _error_header(request, error), ()
    except MemoryError:
        return _refusal(
            f"needs more than the {MAXIMUM_READING_BYTES / 2**30:g} GiB of memory that reading "
            "may take: choose fewer channels or a shorter part"
        ), ()
    except ModuleNotFoundError as error:
        return _refusal(needed(_reader(request), str(error.name))), ()
    except Exception as error:  # on a damaged file a parser may raise anything
        return _refusal(f"is damaged or not of this format: {error or 'unreadable'}"), ()
    return {**header, "sha256": digest}, rows


def _reader(request: Request) -> Reader:
    suffix = request.path.suffix.lower()
    readers = readers_by_suffix()
    if suffix not in readers:
        raise ParameterError(
            f"format {suffix!r}: its reader is not known to the process that reads: put it into a "
            "file for load_plugin, or install it"
        )
    return readers[suffix]


def _recording(request: Request) -> tuple[dict[str, Any], Iterable[Any]]:
    """Header and channels of a recording."""
    reader = _reader(request)
    with READERS.fenced(reader.name, ParameterError, StorageError):
        recording = reader.read(request)
        if request.opening and recording.total_samples:
            _check_last(reader, recording, request)
        return _handed_over(recording, request)


def _check_last(reader: Reader, header: Recorded, request: Request) -> None:
    """Refuse a file whose header claims samples that cannot be read, before a plan is made."""
    _, last = request.planned(int(header.total_samples or 0), header.sample_rate_hz)
    reader.read(replace(request, samples=(last - 1, last), opening=None))


def _handed_over(read: Recorded, request: Request) -> tuple[dict[str, Any], Iterable[Any]]:
    recording = _with_units(cut(read, request), request)
    _check(recording, MINIMUM_SAMPLES if request.samples is None else 0)
    header = {
        "names": list(recording.names),
        "units": list(recording.units),
        "samples": len(recording.samples[0]),
        "sample_rate_hz": float(recording.sample_rate_hz),
        "start_time": recording.start_time,
        "full_scale": recording.full_scale,
        "first_sample": recording.first_sample,
        "total_samples": recording.total_samples,
        "calibration": list(recording.calibration) or [None] * len(recording.names),
        "line": recording.line,
        "counts": list(recording.counts) or [""] * len(recording.names),
        "remarks": [*recording.remarks],
        "overloads": [overload and overload._asdict() for overload in overloads(recording)],
        "extents": [extent._asdict() for extent in extents(recording)],
    }
    return header, recording.samples


def _with_units(recording: Recorded, request: Request) -> Recorded:
    """Recording without the channels of unknown unit that nobody asks for."""
    chosen = request.chosen(recording.names, recording.units)
    if request.channels is not None or len(chosen) == len(recording.names):
        return recording
    fields = ("names", "units", "samples", "limits", "calibration", "counts")
    values = {name: getattr(recording, name) for name in fields}
    changed: dict[str, Any] = {
        name: [value[c] for c in chosen] for name, value in values.items() if value
    }
    omissions = request.omissions(recording.names, recording.units)
    return replace(recording, **changed, remarks=[*recording.remarks, *omissions])


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def cut(recording: Recorded, request: Request) -> Recorded:
    """The part that was asked for, where the reader has read all."""
    if recording.first_sample is not None or not recording.samples:
        return recording
    total = len(recording.samples[0])
    first, last = 0, total
    if not request.wants_all:
        first, last = request.part(total, recording.sample_rate_hz)
    samples = recording.samples if request.wants_all else [s[first:last] for s in recording.samples]
    return replace(recording, samples=samples, first_sample=first, total_samples=total)


def _error_header(request: Request, error: VibroacousticsError) -> dict[str, Any]:
    """Words on an error for the user; of a plug-in that misses a module, what to install."""
    missing = error.__cause__
    if isinstance(error, FaultError) and isinstance(missing, ModuleNotFoundError):
        return _refusal(needed(_reader(request), str(missing.name)))
    return {"error": type(error).__name__, "message": str(error)}


def _refusal(message: str) -> dict[str, Any]:
    return {"error": StorageError.__name__, "message": message}


def _check(recording: Recorded, minimum: int) -> None:
    """Refuse channels that have no form that can be handed over."""
    if not recording.samples:
        raise ParameterError("no channel is chosen")
    for name, samples in zip(recording.names, recording.samples, strict=True):
        if samples.ndim != 1 or samples.dtype.kind not in "iuf":
            raise StorageError(f"channel {name!r}: its samples are no real numbers")
        if len(samples) < minimum:
            raise ParameterError(
                f"channel {name!r}: has {len(samples)} samples; at least {minimum} needed"
            )
        if len(samples) != len(recording.samples[0]):
            raise ParameterError(
                f"channel {name!r}: has {len(samples)} samples, {recording.names[0]!r} "
                f"{len(recording.samples[0])}: choose channels of the same length"
            )
    check_size(len(recording.samples), len(recording.samples[0]))


def main() -> None:
    """Read the file that the arguments name and write it to standard output."""
    _limit(resource.RLIMIT_AS, MAXIMUM_READING_BYTES)
    _limit(resource.RLIMIT_CPU, MAXIMUM_CPU_S)
    _limit(resource.RLIMIT_CORE, 0)
    output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # a parser that prints does no harm
    _write(output, *_typed_answer(json.loads(sys.argv[1])))


def _typed_answer(fields: Mapping[str, Any]) -> tuple[dict[str, Any], list[Any]]:
    """Header, with the type in which samples are handed over, and channels."""
    header, rows = answer(_request(fields), fields.get("plugin"), fields.get("hashed", True))
    channels = list(rows)
    kind = _common_type(channels) if fields.get("as_stored") else "<f8"
    return {**header, "type": kind}, channels


def _common_type(channels: Sequence[Any]) -> str:
    """Type of the samples of all channels where it is a small one, else float64."""
    kinds = {samples.dtype.str for samples in channels}
    return kinds.pop() if len(kinds) == 1 and kinds <= set(_SMALL_TYPES) else "<f8"


def _request(fields: Mapping[str, Any]) -> Request:
    channels, samples = fields["channels"], fields.get("samples")
    opening, line = fields.get("opening"), fields.get("line")
    return Request(
        Path(fields["path"]),
        None if channels is None else tuple(channels),
        fields["sample_rate_hz"],
        fields.get("modes", False),
        fields.get("from_s"),
        fields.get("to_s"),
        None if samples is None else (samples[0], samples[1]),
        None if opening is None else (opening[0], opening[1]),
        tuple(fields.get("units", ())),
        None if line is None else (line[0], line[1], line[2]),
    )


def _limit(kind: int, amount: int) -> None:
    """Lower a limit of this process; one that is already lower stays."""
    _, hard = resource.getrlimit(kind)
    allowed = amount if hard == resource.RLIM_INFINITY else min(amount, hard)
    resource.setrlimit(kind, (allowed, hard))


def _write(output: BinaryIO, header: dict[str, Any], channels: Sequence[Any]) -> None:
    with output:
        output.write(json.dumps(header).encode() + b"\n")
        for samples in channels:
            for start in range(0, len(samples), PIECE):
                piece = np.ascontiguousarray(samples[start : start + PIECE], header["type"])
                output.write(piece.data.cast("B"))


if __name__ == "__main__":
    main()
