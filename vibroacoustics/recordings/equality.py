"""Recordings that are one: files of equal bytes, and channels of equal samples."""

import hashlib
from collections.abc import Hashable, Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.recording_blocks import READ_BYTES, RecordingBlocks

_LEAST_SAMPLES: Final = 10
"""Equal samples that are no chance."""


def identities(recording: RecordingBlocks, channels: Sequence[str]) -> list[tuple[str, Hashable]]:
    """Marks, each with what it marks in words, of which two recordings share one if they are one.

    Of a long recording the first 128 MiB count, and the number of samples; channels whose samples
    are all equal do not count.

    Parameters
    ----------
    recording : recording from memory or from a file
    channels : names of the channels that count, at least one
    """
    attributes, marks = recording.attributes, list[tuple[str, Hashable]]()
    if "source_sha256" in attributes:
        part = (attributes.get("part_start_s"), recording.samples)
        marks.append(("the bytes", (attributes["source_sha256"], *part)))
    last = min(recording.samples, max(READ_BYTES // (8 * len(channels)), 1))
    digests = [
        _digest(samples)
        for samples in recording.read(channels, 0, last)
        if np.min(samples) < np.max(samples)
    ]
    if digests and last >= _LEAST_SAMPLES:
        marks.append(("the samples", (recording.samples, *sorted(digests))))
    return marks


def _digest(samples: Array) -> str:
    return hashlib.blake2b(np.ascontiguousarray(samples).data.cast("B")).hexdigest()
