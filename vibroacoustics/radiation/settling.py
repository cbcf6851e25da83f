"""End of a run by the changes that it still makes at the microphones."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from .arrays import Array, ComplexArray, IndexArray

SETTLED: Final = 1e-3
"""Share of a pressure that may be left out at the end of a run: 0.009 dB."""
_BLOCKS: Final = 3
"""Blocks whose largest change counts, against as many before them."""
_SLOWEST: Final = 0.9
"""Largest decay by block: changes that stay or grow count as this."""
_POINTS: Final = 6
_LOWEST_FREQUENCIES: Final = 8
_OTHER_FREQUENCIES: Final = 16
MOST_WATCHED: Final = _POINTS * (_LOWEST_FREQUENCIES + _OTHER_FREQUENCIES)
"""Pressures that a run is watched by, at most."""


class Settling:
    """Part of the pressure at some points that is still to come, by frequency.

    What a block of time adds to a pressure falls by about the same factor r from block to block,
    fast while sound leaves the grid, slowly where a mode rings on: r/(1 - r) times the last
    addition remains. Pressures count against the largest of all points at their frequency, so a
    microphone in a null keeps no run going.
    """

    def __init__(self, other_parts: Array) -> None:
        """`other_parts` (frequency,): largest pressure that other runs of the pattern gave."""
        self._other_parts = other_parts
        self._previous: ComplexArray | None = None
        self._changes: list[Array] = []
        self.largest = other_parts
        """Largest pressure of all points, of this run or others of the pattern, (frequency,)."""

    def add(self, pressure: ComplexArray) -> None:
        """Tell the pressure (frequency, point) at the end of a block."""
        self.largest = np.maximum(np.abs(pressure).max(axis=1), self._other_parts)
        if self._previous is not None:
            self._changes.append(np.abs(pressure - self._previous).max(axis=1))
        self._previous = pressure

    def remaining(self) -> Array:
        """Estimated share of the pressure that is still to come, (frequency,)."""
        if len(self._changes) < 2 * _BLOCKS:
            return np.full(self.largest.shape, np.inf)
        tiny = np.finfo(float).tiny
        recent = np.max(self._changes[-_BLOCKS:], axis=0)
        earlier = np.max(self._changes[-2 * _BLOCKS : -_BLOCKS], axis=0)
        decay = np.minimum((recent / np.maximum(earlier, tiny)) ** (1.0 / _BLOCKS), _SLOWEST)
        result: Array = recent / np.maximum(self.largest, tiny)
        result *= np.maximum(1.0, decay / (1.0 - decay))
        return result


def spread_points(points: Array) -> Array:
    """A few of some points (point, 3), each the furthest from those before it."""
    chosen = [0]
    distance = np.linalg.norm(points - points[0], axis=1)
    while len(chosen) < min(_POINTS, points.shape[0]):
        chosen.append(int(np.argmax(distance)))
        distance = np.minimum(distance, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return np.asarray(points[chosen])


def watched_frequencies(frequency_hz: Array) -> IndexArray:
    """Indices of the lowest frequencies, where sound settles last, and of others between them."""
    rising = np.argsort(frequency_hz, kind="stable")
    others = np.linspace(0, rising.size - 1, _OTHER_FREQUENCIES).round().astype(int)
    chosen: Sequence[int] = [*range(min(_LOWEST_FREQUENCIES, rising.size)), *others]
    return np.asarray(rising[np.unique(chosen)])
