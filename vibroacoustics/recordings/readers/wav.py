"""WAV: PCM and IEEE float. The file states no unit; integers are fractions of full scale."""

import os
import struct
from typing import BinaryIO, Final

import numpy as np

from ...base.errors import StorageError
from ...base.registry import register
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size

_BYTE_ORDER: Final = {b"RIFF": "<", b"RIFX": ">", b"RF64": "<"}


def read(request: Request) -> Recorded:
    """Channels `channel 1`, `channel 2` … of a WAV file.

    Raises
    ------
    StorageError
        The file is no WAV file, is truncated or too large.
    """
    from scipy.io import wavfile

    with request.path.open("rb") as file:
        _check_chunks(file)
    file_rate, stored = wavfile.read(request.path)
    frames = stored.reshape(len(stored), -1)
    names = [f"channel {number}" for number in range(1, frames.shape[1] + 1)]
    chosen = request.chosen(names)
    return Recorded(
        names=[names[column] for column in chosen],
        units=[""] * len(chosen),
        samples=[_full_scale_fraction(frames[:, column]) for column in chosen],
        sample_rate_hz=request.sample_rate_hz or float(file_rate),
        full_scale=stored.dtype.kind in "iu",
    )


def _full_scale_fraction(stored: Samples) -> Samples:
    """Integers over half their range, so that full scale is 1; 8 bits are stored from 0 to 255."""
    if stored.dtype.kind == "f":
        return stored
    half_range = 2.0 ** (8 * stored.dtype.itemsize - 1)
    offset = half_range if stored.dtype.kind == "u" else 0.0
    return np.asarray((stored - offset) / half_range)


def _check_chunks(file: BinaryIO) -> None:
    """Walk through the chunks: each must lie within the file, and the samples within the cap."""
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    head = file.read(12)
    order = _BYTE_ORDER.get(head[:4])
    if order is None or head[8:] != b"WAVE":
        raise StorageError("is no WAV file: it does not begin with RIFF and WAVE")
    long_size, block = 0, b""
    while len(chunk := file.read(8)) == 8:
        name, claimed = struct.unpack(f"{order}4sI", chunk)
        start = file.tell()
        if name == b"data" and head[:4] == b"RF64":
            claimed = long_size
        if claimed > size - start:
            raise StorageError(
                f"chunk {name.decode('latin-1')!r} claims {claimed} bytes, {size - start} follow: "
                "the file is truncated or was never finished"
            )
        if name == b"fmt ":
            block = file.read(16)
        elif name == b"ds64":
            long_size = int.from_bytes(file.read(16)[8:], "little")
        elif name == b"data":
            _check_data(block, order, claimed)
            return
        file.seek(start + claimed + claimed % 2)  # chunks begin at even places
    raise StorageError("holds no samples: it has no data chunk")


def _check_data(block: bytes, order: str, size: int) -> None:
    if len(block) < 16:
        raise StorageError("has no format chunk before its samples")
    channels, _, _, frame_bytes = struct.unpack(f"{order}HIIH", block[2:14])
    if channels == 0 or frame_bytes < channels:
        raise StorageError(f"claims {channels} channels in {frame_bytes} bytes a sample")
    check_size(channels, size // frame_bytes)


register(Reader("wav", (".wav",), "WAV", read))
