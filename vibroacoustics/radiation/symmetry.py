"""Mirror symmetry: a symmetric body needs one half, quarter or eighth of the grid around it."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .arrays import Array, IndexArray
from .bodies import Body
from .lines import fluid_on_lines

_LINES: Final = 150
_CELLS: Final = 50
_SAME: Final = 1e-4
"""Shares of cells that differ by no more are the same: a file in single precision rounds so."""


def symmetric_axes(body: Body, axes: Sequence[int] = (0, 1, 2)) -> tuple[int, ...]:
    """Those axes along which a body is its own mirror image about its middle, by lines along each.

    However its surface is divided into triangles.
    """
    lower, upper = body.bounds()
    symmetric = []
    for axis in axes:
        across = tuple(
            np.linspace(lower[other], upper[other], 2 * _LINES + 1)[1::2]
            for other in ((axis + 1) % 3, (axis + 2) % 3)
        )
        edges = np.linspace(lower[axis], upper[axis], _CELLS + 1)
        shares = fluid_on_lines(body, axis, (across[0], across[1]), (1, 1), edges)
        if np.all(np.abs(shares - shares[..., ::-1]) <= _SAME):
            symmetric.append(axis)
    return tuple(symmetric)


def both_halves(upper: Array, axes: Sequence[int], faces: int | None = None) -> Array:
    """Values even along some axes, of which the upper half is given.

    Takes cells, or faces across the axis `faces`, whose first ones are in the middle plane.
    """
    for axis in axes:
        lower = np.flip(upper, axis)
        if axis == faces:
            lower = lower.take(np.arange(upper.shape[axis] - 1), axis)
        upper = np.concatenate([lower, upper], axis)
    return upper


def upper_half(values: Array, axes: Sequence[int]) -> Array:
    """Upper half along some axes of values of cells, or of faces together with the middle one."""
    return values[
        tuple(
            slice(count // 2 if axis in axes else 0, None)
            for axis, count in enumerate(values.shape)
        )
    ]


def images(
    cells: IndexArray, shape: Sequence[int], axes: Sequence[int]
) -> tuple[IndexArray, NDArray[np.bool_]]:
    """Flat index in the upper half of each cell's image, and whether that lies across each axis.

    Cells (...) are flat indices in the whole grid; the second array is (axis, ...).
    """
    index, size = list(np.unravel_index(cells, tuple(shape))), list(shape)
    across = np.zeros((len(axes), *cells.shape), dtype=bool)
    for number, axis in enumerate(axes):
        middle = size[axis] = shape[axis] // 2
        across[number] = index[axis] < middle
        index[axis] = np.where(across[number], middle - 1 - index[axis], index[axis] - middle)
    return np.ravel_multi_index(tuple(index), tuple(size)), across


def signs(across: NDArray[np.bool_], parity: Sequence[int]) -> IndexArray:
    """Sign of a field, even (1) or odd (-1) along each axis, at cells (...) over their images."""
    by_axis = np.reshape(np.array(parity, dtype=int), (-1, *[1] * (across.ndim - 1)))
    return np.asarray(np.where(across, by_axis, 1).prod(axis=0))
