"""Recording of the box in the upper half of a grid, and its join with Green's functions.

Fields that are even or odd about the grid's middle planes stay in the recorded cells of the upper
half until they are joined: they take a half, a quarter or an eighth of the memory of the box.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .arrays import Array, ComplexArray, IndexArray
from .box import Box
from .near_grid import NearGrid
from .symmetry import images, signs

Parity = tuple[int, ...]
"""1 where a field is even along a mirrored axis of its grid, -1 where it is odd."""


@dataclass(frozen=True)
class PartField:
    """Sound pressure of one parity in the recorded cells."""

    parity: Parity
    spectrum: ComplexArray
    """(frequency, cell), Pa."""


@dataclass(frozen=True)
class Recording:
    """The recorded cells, and where the box's layers find their images among them."""

    cells: IndexArray
    """Flat indices in the upper half of the grid, (cell,)."""
    columns: IndexArray
    """Recorded cell that is the image of each of the inner and outer layer's, (2, pair)."""
    across: NDArray[np.bool_]
    """Whether those lie across the middle of each mirrored axis, (axis, 2, pair)."""
    weights: Array
    """Weights of the box, (pair,)."""

    def join_matrix(self, parity: Parity) -> Any:
        """Sparse matrix (cell, 2 pairs): from a Green's function to what joins a part with it.

        Greens' functions are given on the inner layer, then on the outer one. With the matrix M,
        the pressure p of a part and the Green's function G, p M G is the integral of `join`.
        """
        inner, outer = signs(self.across, parity)
        pairs = np.arange(self.weights.size)
        return sparse.csr_array(
            (
                np.concatenate([inner * self.weights, -outer * self.weights]),
                (self.columns.ravel(), np.concatenate([pairs + pairs.size, pairs])),
            ),
            shape=(self.cells.size, 2 * pairs.size),
        )


def recording(grid: NearGrid, box: Box) -> Recording:
    """The recorded cells of a grid's box."""
    image, across = images(_layers(grid), grid.shape, grid.mirrored)
    cells, columns = np.unique(image, return_inverse=True)
    return Recording(cells, columns.reshape(image.shape), across, box.weights)


def _layers(grid: NearGrid) -> IndexArray:
    """Flat indices of the cells inside and outside of each face of the box, (2, pair)."""
    layers = []
    for axis, sign in grid.box_sides:
        ranges: list[IndexArray] = [
            np.arange(a, b) for a, b in zip(grid.box_start, grid.box_stop, strict=True)
        ]
        inner_cell = grid.box_stop[axis] - 1 if sign > 0 else grid.box_start[axis]
        side = []
        outer_cell = inner_cell if (axis, sign) in grid.on_walls else inner_cell + sign
        for cell in (inner_cell, outer_cell):
            ranges[axis] = np.array([cell])
            side.append(np.ravel_multi_index(np.ix_(*ranges), grid.shape).ravel())
        layers.append(np.stack(side))
    return np.concatenate(layers, axis=1)
