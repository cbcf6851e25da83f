"""Samples that a file holds time by time, put together channel by channel."""

from collections.abc import Callable
from typing import Final

import numpy as np

from .recorded import Samples

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
