"""The uniform staggered grid around the body: cells, absorbing layers and the recording box."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array
from .box import Side, open_sides
from .mirrors import Mirror

COURANT_NUMBER: Final = 0.3
PML_CELLS: Final = 10
PML_ALPHA: Final = 2.0
BOX_MARGIN_M: Final = 0.04
_BOX_MARGIN_CELLS: Final = 3
_GAP_CELLS: Final = 2
"""Cells between box and absorbing layer: what the recording stencil reaches."""


@dataclass(frozen=True)
class NearGrid:
    """Cubic cells; pressure at cell centres, velocity components on the faces between them.

    The outermost faces are closed. Where they lie in a hard wall, that is an exact mirror of the
    discrete equations and has no absorbing layer.
    """

    spacing_m: float
    origin: Array
    """Lower corner of the grid, m."""
    shape: tuple[int, int, int]
    box_start: tuple[int, int, int]
    """First cell inside the recording box, by axis."""
    box_stop: tuple[int, int, int]
    on_walls: frozenset[Side]
    """Sides of the grid, and of the box, that lie on hard walls."""

    @property
    def time_step_s(self) -> float:
        return COURANT_NUMBER * self.spacing_m / SPEED_OF_SOUND_M_PER_S

    @property
    def box_lower(self) -> Array:
        return self.origin + self.spacing_m * np.array(self.box_start)

    @property
    def box_upper(self) -> Array:
        return self.origin + self.spacing_m * np.array(self.box_stop)

    def absorption(self, axis: int) -> tuple[Array, Array]:
        """Factors of one half step in the layers: (cells,), (interior faces,) along an axis.

        k-Wave's profile exp(-alpha (c/dx) (depth/thickness)^4 dt/2), where the depth of a cell
        centre or face is counted so that the outermost cell has the full thickness
        (Treeby and Cox, J. Biomed. Opt. 15 (2010) 021314).
        """
        cells = np.arange(self.shape[axis], dtype=float)
        return self._damping(cells, axis), self._damping(cells[:-1] + 0.5, axis)

    def _damping(self, position: Array, axis: int) -> Array:
        depth = np.zeros(position.shape)
        if (axis, -1) not in self.on_walls:
            depth = np.maximum(depth, PML_CELLS - position)
        if (axis, 1) not in self.on_walls:
            depth = np.maximum(depth, position - (self.shape[axis] - 1 - PML_CELLS))
        damping: Array = np.exp(-0.5 * PML_ALPHA * COURANT_NUMBER * (depth / PML_CELLS) ** 4)
        return damping


def near_grid(
    bounds: tuple[Array, Array],
    spacing_m: float,
    walls: Sequence[Mirror] = (),
    box_margin_m: float = BOX_MARGIN_M,
) -> NearGrid:
    """Grid whose recording box stands at least `box_margin_m` off the bounds of the body.

    The box is centred on the body; it ends on every wall, where a plane of faces lies.
    """
    lower, upper = bounds
    margin = max(box_margin_m, _BOX_MARGIN_CELLS * spacing_m)
    middle = (lower + upper) / 2
    cells = 2 * np.ceil(((upper - lower) / 2 + margin) / spacing_m - 1e-9).astype(int)
    box_lower = middle - cells / 2 * spacing_m
    beyond = {side: PML_CELLS + _GAP_CELLS for side in open_sides(())}
    for wall in walls:
        axis, sign, position = wall.axis, wall.sign, wall.position_m
        reach = position - lower[axis] if sign > 0 else upper[axis] - position
        cells[axis] = int(np.ceil((reach + margin) / spacing_m - 1e-9))
        box_lower[axis] = position - (cells[axis] * spacing_m if sign > 0 else 0.0)
        beyond[axis, sign] = 0
    start = np.array([beyond[axis, -1] for axis in range(3)])
    stop = np.array([beyond[axis, 1] for axis in range(3)])
    return NearGrid(
        spacing_m=spacing_m,
        origin=box_lower - start * spacing_m,
        shape=_triple(start + cells + stop),
        box_start=_triple(start),
        box_stop=_triple(start + cells),
        on_walls=frozenset((wall.axis, wall.sign) for wall in walls),
    )


def _triple(numbers: NDArray[np.int_]) -> tuple[int, int, int]:
    first, second, third = (int(number) for number in numbers)
    return first, second, third
