"""Beats: lines of several machines that are close in frequency, and the levels between them."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray

LARGEST_BEAT_HZ: Final = 5.0
"""Lines no further apart than this beat (assumed, range 4 to 20 Hz: faster than some 20 Hz it is
heard as roughness; H. Fastl and E. Zwicker, Psychoacoustics, 2007, chapters 10 and 11)."""
HIGHEST_ORDER: Final = 15
_ROUNDING_HZ: Final = 1e-9


class MachineLine(NamedTuple):
    """A shaft order of one machine.

    Attributes
    ----------
    machine : its name
    order : order of its shaft
    frequency_hz : frequency of the line
    """

    machine: str
    order: int
    frequency_hz: float


class Beat(NamedTuple):
    """Two lines that beat.

    Attributes
    ----------
    first : number of a line
    second : number of a line of another machine
    frequency_hz : frequency of the beat, the difference of both; 0 where the phase between them is
        constant
    """

    first: int
    second: int
    frequency_hz: float


def beats(lines: Sequence[MachineLine]) -> list[Beat]:
    """Return all pairs of lines of two machines up to order 15 that are at most 5 Hz apart.

    Parameters
    ----------
    lines : lines of all machines
    """
    return [
        Beat(first, second, abs(a.frequency_hz - b.frequency_hz))
        for (first, a), (second, b) in combinations(enumerate(lines), 2)
        if a.machine != b.machine
        and 1 <= min(a.order, b.order) <= max(a.order, b.order) <= HIGHEST_ORDER
        and abs(a.frequency_hz - b.frequency_hz) <= LARGEST_BEAT_HZ + _ROUNDING_HZ
    ]


def groups(size: int, pairs: Sequence[Beat]) -> Iterator[list[int]]:
    """Give the numbers of lines that beat with one another, directly or by others.

    Parameters
    ----------
    size : number of lines
    pairs : that beat
    """
    group = list(range(size))
    for beat in pairs:
        joined, replaced = group[beat.first], group[beat.second]
        group = [joined if number == replaced else number for number in group]
    for number in dict.fromkeys(group):
        yield [line for line in range(size) if group[line] == number]


def envelope_maximum(pressure_pa: ComplexArray, axis: int = 0) -> Array:
    """Return the largest envelope of lines that beat, Pa: Σ |P|, where their phases meet.

    |p₁ + p₂| of two lines runs from ||P₁| - |P₂|| to |P₁| + |P₂| within one beat; of equal
    frequencies this is the worst relative phase.

    Parameters
    ----------
    pressure_pa : complex peaks, shape (..., line, ...) with the lines along the axis
    axis : axis of the lines
    """
    return np.asarray(np.abs(pressure_pa).sum(axis=axis))


def envelope_minimum(pressure_pa: ComplexArray, axis: int = 0) -> Array:
    """Return the smallest envelope of lines that beat, Pa; 0 where the loudest can be cancelled.

    2 max|P| - Σ |P|, at least 0.

    Parameters
    ----------
    pressure_pa : complex peaks, shape (..., line, ...) with the lines along the axis
    axis : axis of the lines
    """
    size = np.abs(pressure_pa)
    return np.asarray(np.maximum(2.0 * size.max(axis=axis) - size.sum(axis=axis), 0.0))
