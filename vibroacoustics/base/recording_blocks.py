"""A recording as analyses read it: channels of one sample rate, a block at a time."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, Protocol

from .arrays import Array

READ_BYTES: Final = 2**27
"""Read at a time from a file: the start of the process that reads is then a small part of it."""
BLOCK_BYTES: Final = 2**23
"""Worked on at a time: it stays in the cache."""


class RecordingBlocks(Protocol):
    """Channels of one sample rate and length that are read a block at a time."""

    @property
    def sample_rate_hz(self) -> float:
        """Actual sample rate."""

    @property
    def samples(self) -> int:
        """Number of samples of a channel in all blocks."""

    @property
    def channels(self) -> Sequence[str]:
        """Names, each once."""

    @property
    def channel_units(self) -> Sequence[str]:
        """SI unit of each channel's samples."""

    @property
    def calibration_factors(self) -> Sequence[float]:
        """SI unit per unit stored, already applied, of each channel."""

    @property
    def read_bytes(self) -> int:
        """Samples that are best read at a time, in bytes of float64."""

    @property
    def attributes(self) -> Mapping[str, Any]:
        """Those of the recording in the labelled form, where known: `source_file`, …"""

    def read(self, channels: Sequence[str], first: int, last: int) -> Array:
        """Samples `first` up to, but not with, `last`; shape (channel, time), SI units."""


def block_by_block(recording: RecordingBlocks, channels: Sequence[str]) -> Iterator[Array]:
    """All samples of some channels in blocks of `BLOCK_BYTES`, each of shape (channel, time)."""
    step = max(BLOCK_BYTES // (8 * len(channels)), 1)
    read = step * max(recording.read_bytes // BLOCK_BYTES, 1)
    for first in range(0, recording.samples, read):
        samples = recording.read(channels, first, min(first + read, recording.samples))
        for begin in range(0, samples.shape[1], step):
            yield samples[:, begin : begin + step]
