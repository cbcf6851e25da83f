"""The uniform staggered grid around the body: cells, absorbing layers and the recording box."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array
from .bodies import Body

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

    Above a floor the lowest faces lie in the floor plane: they are closed, so the floor is an exact
    mirror of the discrete equations and has no absorbing layer.
    """

    spacing_m: float
    origin: Array
    """Lower corner of the grid, m."""
    shape: tuple[int, int, int]
    box_start: tuple[int, int, int]
    """First cell inside the recording box, by axis."""
    box_stop: tuple[int, int, int]
    on_floor: bool

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
        has_lower = not (self.on_floor and axis == 2)
        return (
            self._damping(cells, self.shape[axis], has_lower),
            self._damping(cells[:-1] + 0.5, self.shape[axis], has_lower),
        )

    def _damping(self, position: Array, count: int, has_lower: bool) -> Array:
        depth = position - (count - 1 - PML_CELLS)
        if has_lower:
            depth = np.maximum(depth, PML_CELLS - position)
        relative = np.maximum(depth, 0.0) / PML_CELLS
        damping: Array = np.exp(-0.5 * PML_ALPHA * COURANT_NUMBER * relative**4)
        return damping


def near_grid(
    body: Body, spacing_m: float, floor_z_m: float | None, box_margin_m: float = BOX_MARGIN_M
) -> NearGrid:
    """Grid whose recording box stands at least `box_margin_m` off the body.

    The box is centred on the body; above a floor it ends on the floor, where a face plane lies.
    """
    lower, upper = body.bounds()
    margin = max(box_margin_m, _BOX_MARGIN_CELLS * spacing_m)
    middle = (lower + upper) / 2
    half_cells = np.ceil(((upper - lower) / 2 + margin) / spacing_m - 1e-9).astype(int)
    cells = 2 * half_cells
    box_lower = middle - half_cells * spacing_m
    outer = PML_CELLS + _GAP_CELLS
    start = np.full(3, outer)
    if floor_z_m is not None:
        box_lower[2] = floor_z_m
        cells[2] = int(np.ceil((upper[2] + margin - floor_z_m) / spacing_m - 1e-9))
        start[2] = 0
    return NearGrid(
        spacing_m=spacing_m,
        origin=box_lower - start * spacing_m,
        shape=_triple(start + cells + outer),
        box_start=_triple(start),
        box_stop=_triple(start + cells),
        on_floor=floor_z_m is not None,
    )


def _triple(numbers: NDArray[np.int_]) -> tuple[int, int, int]:
    first, second, third = (int(number) for number in numbers)
    return first, second, third
