"""Chunks of a WAV file: its samples, their form, and the unit that this package writes there."""

import math
import os
import re
import struct
from collections.abc import Iterable
from dataclasses import dataclass
from typing import BinaryIO, Final, Literal

from ..base.decibel import amplitude_of_level
from ..base.errors import StorageError

_BEFORE, _BEHIND = "vibroacoustics: ", " at full scale"
_ONE: Final = re.compile(r"(?P<factor>[0-9.e+-]+) (?P<unit>\S(?:.*\S)?)")


def scale_comment(scales: Iterable[tuple[float, str]]) -> str:
    """Comment of a file whose samples are in parts of a full scale.

    Parameters
    ----------
    scales : value at full scale and its unit, by channel

    Examples
    --------
    >>> scale_comment([(0.5, "Pa"), (1.0, "m/s²")])
    'vibroacoustics: 0.5 Pa, 1.0 m/s² at full scale'
    """
    words = ", ".join(f"{float(factor)!r} {unit}" for factor, unit in scales)
    return f"{_BEFORE}{words}{_BEHIND}"


def stated_scales(comment: str, channels: int) -> list[tuple[float, str]]:
    """Value at full scale and unit by channel; none where another wrote the comment."""
    if not (comment.startswith(_BEFORE) and comment.endswith(_BEHIND)):
        return []
    parts = comment.removeprefix(_BEFORE).removesuffix(_BEHIND).split(", ")
    scales = [scale for part in parts if (scale := _scale(part)) is not None]
    return scales if len(scales) == len(parts) == channels else []


def _scale(words: str) -> tuple[float, str] | None:
    match = _ONE.fullmatch(words)
    if match is None:
        return None
    try:
        factor = float(match["factor"])
    except ValueError:
        return None
    return (factor, match["unit"]) if 0.0 < factor < math.inf else None


PCM, FLOAT, _EXTENSIBLE = 0x0001, 0x0003, 0xFFFE
ByteOrder = Literal["<", ">"]
_BYTE_ORDER: Final[dict[bytes, ByteOrder]] = {
    b"RIFF": "<",
    b"RIFX": ">",
    b"RF64": "<",
    b"BW64": "<",
}
_LONG: Final = (b"RF64", b"BW64")
_MAXIMUM_COMMENT: Final = 2**16
_OCEAN_SONICS: Final = re.compile(
    r"(?P<volt>[0-9.]+) V pk, *(?P<sensitivity>-[0-9.]+) dBV re 1uPa"
    r"(?:.*?, *(?P<count>[0-9]+) = Max Count)?"
)
"""Comment of Ocean Sonics' hydrophones (icListen AF User Guide, 2017, table of the WAV header)."""


@dataclass(frozen=True)
class Wave:
    """Chunks before and behind the samples of a WAV file.

    Attributes
    ----------
    order : order of bytes, `<` or `>`
    kind : kind of the samples, PCM or FLOAT, or another number of the format
    channels, sample_rate_hz : channels and sample rate of the samples
    sample_bytes : bytes of one channel
    start : place of the first sample in the file
    frames : samples of a channel
    comment : text beside the samples; empty without one
    """

    order: ByteOrder
    kind: int
    channels: int
    sample_rate_hz: float
    sample_bytes: int
    start: int
    frames: int
    comment: str

    @property
    def pascal_at_full_scale(self) -> float | None:
        """Calibration that the recorder wrote into its comment; None without one."""
        match = _OCEAN_SONICS.match(self.comment)
        if match is None:
            return None
        full_scale = 2.0 ** (8 * self.sample_bytes - 1)
        largest = float(match["count"] or full_scale)
        volt = float(match["volt"]) * full_scale / largest
        return float(volt * amplitude_of_level(-float(match["sensitivity"])) * 1e-6)


def read_wave(file: BinaryIO) -> Wave:
    """Walk through the chunks: those up to the samples must lie within the file.

    Raises
    ------
    StorageError
        The file is no WAV file, or claims more than it holds.
    """
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    head = file.read(12)
    order = _BYTE_ORDER.get(head[:4])
    if order is None or head[8:] != b"WAVE":
        raise StorageError("is no WAV file: it does not begin with RIFF and WAVE")
    long_size, block, comment = 0, b"", ""
    while len(chunk := file.read(8)) == 8:
        name, claimed = struct.unpack(f"{order}4sI", chunk)
        start = file.tell()
        if name == b"data" and head[:4] in _LONG:
            claimed = long_size
        if claimed > size - start:
            raise StorageError(
                f"chunk {name.decode('latin-1')!r} claims {claimed} bytes, {size - start} follow: "
                "the file is truncated or was never finished"
            )
        if name == b"fmt ":
            block = file.read(min(claimed, 40))
        elif name == b"ds64":
            long_size = int.from_bytes(file.read(16)[8:], "little")
        elif name == b"LIST":
            comment = _comment(file.read(min(claimed, _MAXIMUM_COMMENT)), order) or comment
        elif name == b"data":
            file.seek(start + claimed + claimed % 2)
            return _wave(block, order, start, claimed, comment or _comment_behind(file, order))
        file.seek(start + claimed + claimed % 2)  # chunks begin at even places
    raise StorageError("holds no samples: it has no data chunk")


def with_comment(wave: bytes, comment: str) -> bytes:
    """A WAV file with a comment in a list behind its samples; one of RF64 stays as it is.

    Parameters
    ----------
    wave : the file, RIFF
    comment : comment in letters of Latin-1
    """
    if wave[:4] != b"RIFF":
        return wave
    text = comment.encode("latin-1") + b"\0"
    text += bytes(len(text) % 2)
    content = b"INFO" + struct.pack("<4sI", b"ICMT", len(text)) + text
    file = wave + struct.pack("<4sI", b"LIST", len(content)) + content
    return file[:4] + struct.pack("<I", len(file) - 8) + file[8:]


def _wave(block: bytes, order: ByteOrder, start: int, size: int, comment: str) -> Wave:
    if len(block) < 16:
        raise StorageError("has no format chunk before its samples")
    kind, channels, rate, _, frame_bytes = struct.unpack(f"{order}HHIIH", block[:14])
    if kind == _EXTENSIBLE and len(block) >= 26:
        kind = struct.unpack(f"{order}H", block[24:26])[0]
    if channels == 0 or frame_bytes < channels:
        raise StorageError(f"claims {channels} channels in {frame_bytes} bytes a sample")
    width = frame_bytes // channels
    (bits,) = struct.unpack(f"{order}H", block[14:16])
    needed = -(-bits // 8)
    is_padded = (needed, width) == (3, 4)  # 24 bits in words of 32
    if bits and (width * channels != frame_bytes or (width != needed and not is_padded)):
        raise StorageError(
            f"claims {channels} channels of {bits} bits in {frame_bytes} bytes a sample: "
            f"must be {channels * needed}"
        )
    return Wave(order, kind, channels, float(rate), width, start, size // frame_bytes, comment)


def _comment_behind(file: BinaryIO, order: str) -> str:
    """Comment in a list behind the samples, where nothing needs to be in order."""
    while len(chunk := file.read(8)) == 8:
        name, claimed = struct.unpack(f"{order}4sI", chunk)
        start = file.tell()
        if name == b"LIST":
            return _comment(file.read(min(claimed, _MAXIMUM_COMMENT)), order)
        file.seek(start + claimed + claimed % 2)
    return ""


def _comment(content: bytes, order: str) -> str:
    """Text of ICMT in a list of kind INFO."""
    position = 4
    while content[:4] == b"INFO" and position + 8 <= len(content):
        name, size = struct.unpack(f"{order}4sI", content[position : position + 8])
        if name == b"ICMT":
            return content[position + 8 : position + 8 + size].rstrip(b"\0 ").decode("latin-1")
        position += 8 + size + size % 2
    return ""
