"""A set of cells of a rectangular grid as few rectangles, the largest first."""

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array

Ranges = tuple[tuple[int, int], ...]
"""First cell and the one after the last along each axis."""


def rectangles(chosen: NDArray[np.bool_], lines: list[Array]) -> Iterator[Ranges]:
    """Rectangles that cover the chosen cells once; `lines` bound the cells along each axis, m."""
    left = chosen.copy()
    while left.any():
        ranges = _largest(left, lines)
        left[tuple(slice(*one) for one in ranges)] = False
        yield ranges


def _largest(chosen: NDArray[np.bool_], lines: list[Array]) -> Ranges:
    """The rectangle of the largest measure that holds chosen cells alone."""
    count = np.pad(chosen.astype(int), [(1, 0)] * chosen.ndim)
    for axis in range(chosen.ndim):
        count = np.cumsum(count, axis=axis)
    starts, stops = zip(*(np.triu_indices(number) for number in chosen.shape), strict=True)
    stops = tuple(stop + 1 for stop in stops)
    cells = np.ones([start.size for start in starts], dtype=int)
    measure = np.ones(cells.shape)
    for axis, (start, stop, line) in enumerate(zip(starts, stops, lines, strict=True)):
        form = [-1 if other == axis else 1 for other in range(chosen.ndim)]
        cells = cells * (stop - start).reshape(form)
        measure = measure * (line[stop] - line[start]).reshape(form)
    held = np.zeros(cells.shape, dtype=int)
    for ends in product((0, 1), repeat=chosen.ndim):
        corner = np.ix_(*((stops if end else starts)[axis] for axis, end in enumerate(ends)))
        held += (-1) ** (chosen.ndim - sum(ends)) * count[corner]
    best = np.unravel_index(np.argmax(np.where(held == cells, measure, 0.0)), cells.shape)
    return tuple(
        (int(start[index]), int(stop[index]))
        for start, stop, index in zip(starts, stops, best, strict=True)
    )
