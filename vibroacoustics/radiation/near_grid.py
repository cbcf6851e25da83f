"""The staggered grid around the body: cells, absorbing layers and the recording box."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array
from .bodies import Body
from .box import Side, open_sides
from .exact import Mirror
from .symmetry import symmetric_axes

COURANT_NUMBER: Final = 0.3
"""Courant number of a cell that no plane shapes, unless planes squeeze cells to below 0.38 of
it."""
MOST_OPEN: Final = 18.0
"""Largest stiffness of a cell's open faces over its volume (see `NearGrid.stiffness`).

No discrete mode's squared frequency times the squared time step is above twice that times the
squared Courant number (Gershgorin): 3.24 at 0.3. The scheme is stable below 4.
"""
PML_CELLS: Final = 16
"""Cells of the absorbing layers: with fewer, their echo at low frequencies lasts several times as
long."""
PML_ALPHA: Final = 2.0
_PML_POWER: Final = 3
BOX_MARGIN_M: Final = 0.04
_BOX_MARGIN_CELLS: Final = 3
_GAP_CELLS: Final = 2
"""Cells between box and absorbing layer: what the recording stencil reaches."""
_STRETCH: Final = 0.25
"""A part between two plane faces may be longer than its cells would be by this share of a unit."""
_CLOSEST_PLANES: Final = 0.3
"""Planes closer than this many units to a wall or a larger one do not shape the grid."""


@dataclass(frozen=True)
class NearGrid:
    """Rectangular cells, all but cubic; pressure at their centres, velocities on their faces.

    Planes of faces lie in the walls and, as far as they do not crowd, in the plane faces of the
    body, so that the error of the grid falls smoothly with the spacing. The outermost faces are
    closed; in a hard wall that is an exact mirror of the discrete equations without an absorbing
    layer.
    """

    spacing_m: float
    """Spacing of cells that no plane shapes."""
    edges: tuple[Array, Array, Array]
    """Coordinates of the planes of faces across each axis, m."""
    box_start: tuple[int, int, int]
    """First cell inside the recording box, by axis."""
    box_stop: tuple[int, int, int]
    on_walls: frozenset[Side]
    """Sides of the grid, and of the box, that lie on hard walls."""
    joins_floor: bool = False
    """Whether the box has its side on the floor, too; see `Box`."""
    mirrored: tuple[int, ...] = ()
    """Axes along which body and grid are symmetric about the grid's middle plane."""

    @cached_property
    def upper_half(self) -> "NearGrid":
        """Grid above the middle planes of the mirrored axes; these count as walls."""
        edges, start, stop = list(self.edges), list(self.box_start), list(self.box_stop)
        for axis in self.mirrored:
            middle = self.shape[axis] // 2
            edges[axis] = edges[axis][middle:]
            start[axis], stop[axis] = 0, stop[axis] - middle
        return NearGrid(
            spacing_m=self.spacing_m,
            edges=(edges[0], edges[1], edges[2]),
            box_start=(start[0], start[1], start[2]),
            box_stop=(stop[0], stop[1], stop[2]),
            on_walls=self.on_walls | {(axis, -1) for axis in self.mirrored},
            joins_floor=self.joins_floor,
        )

    @property
    def shape(self) -> tuple[int, int, int]:
        first, second, third = (edges.size - 1 for edges in self.edges)
        return first, second, third

    def centres(self, axis: int) -> Array:
        """Coordinates of the cells' middles, (cell,), m."""
        return np.asarray((self.edges[axis][1:] + self.edges[axis][:-1]) / 2.0)

    def widths(self, axis: int) -> Array:
        """(cell,), m."""
        return np.diff(self.edges[axis])

    def gaps(self, axis: int) -> Array:
        """Distances of neighbouring cells' middles, (interior face,), m."""
        return np.diff(self.centres(axis))

    @property
    def box_pairs(self) -> int:
        """Number of pairs of cells across the faces of the box."""
        size = np.subtract(self.box_stop, self.box_start)
        return sum(int(np.prod(size)) // int(size[axis]) for axis, _ in self.box_sides)

    @property
    def box_sides(self) -> list[Side]:
        """Sides that the box has."""
        return open_sides(self.on_walls, self.joins_floor)

    @property
    def time_step_s(self) -> float:
        return self.courant_number * self.spacing_m / SPEED_OF_SOUND_M_PER_S

    @cached_property
    def courant_number(self) -> float:
        """Courant number of a cell that no plane shapes; `COURANT_NUMBER` where no cell is too
        narrow."""
        stiffest = 2.0 * sum(float(self.stiffness(axis).max()) for axis in range(3))
        return COURANT_NUMBER * min(1.0, float(np.sqrt(MOST_OPEN / stiffest)))

    def stiffness(self, axis: int) -> Array:
        """Spacing² over width times gap, the larger of both faces, of cells along an axis, (cell,).

        That of a cell's open face is what the pressure difference across it changes in the cell,
        in squared Courant numbers.
        """
        gaps = np.concatenate([self.widths(axis)[:1], self.gaps(axis), self.widths(axis)[-1:]])
        nearest = np.minimum(gaps[:-1], gaps[1:])
        return np.asarray(self.spacing_m**2 / (self.widths(axis) * nearest))

    def middles(self, cells: NDArray[np.intp]) -> Array:
        """Middles (cell, 3) of cells given by flat index, m."""
        index = np.unravel_index(cells, self.shape)
        return np.stack([self.centres(axis)[index[axis]] for axis in range(3)], axis=1)

    def cells_at(self, points: Array) -> NDArray[np.intp]:
        """Flat index of the cell that holds each point (point, 3)."""
        index = [
            np.searchsorted(edges, points[:, axis], side="right") - 1
            for axis, edges in enumerate(self.edges)
        ]
        return np.ravel_multi_index(tuple(index), self.shape, mode="clip")

    def absorption(self, axis: int) -> tuple[Array, Array]:
        """Factors of one half step in the layers: (cells,), (interior faces,) along an axis.

        k-Wave's profile exp(-alpha (c/dx) (depth/thickness)^n dt/2), but n = 3 instead of 4; the
        depth of a cell centre or face is counted so that the outermost cell has the full thickness
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
        exponent = 0.5 * PML_ALPHA * self.courant_number * (depth / PML_CELLS) ** _PML_POWER
        return np.asarray(np.exp(-exponent))


def near_grid(
    body: Body,
    spacing_m: float,
    walls: Sequence[Mirror] = (),
    box_margin_m: float = BOX_MARGIN_M,
    cells_per_unit: int = 3,
) -> NearGrid:
    """Grid whose recording box stands at least `box_margin_m` off the body and ends on the walls.

    Every part between two planes has a whole multiple of `cells_per_unit` cells: grids whose units
    (cells_per_unit times spacing) are the same have the same planes. Along an axis without walls
    along which the body is symmetric, the grid is so too.
    """
    walled = {wall.axis for wall in walls}
    mirrored = symmetric_axes(body, [axis for axis in range(3) if axis not in walled])
    edges, start, stop = [], [], []
    for axis in range(3):
        wall_positions = {wall.sign: wall.position_m for wall in walls if wall.axis == axis}
        if axis in mirrored:
            wall_positions[-1] = float(np.mean([corner[axis] for corner in body.bounds()]))
        line, first, last = _axis(
            body, axis, spacing_m, wall_positions, box_margin_m, cells_per_unit
        )
        if axis in mirrored:
            line = np.concatenate([2.0 * line[0] - line[:0:-1], line])
            first, last = line.size - 1 - (line.size // 2 + last), line.size // 2 + last
        edges.append(line)
        start.append(first)
        stop.append(last)
    return NearGrid(
        spacing_m=spacing_m,
        edges=(edges[0], edges[1], edges[2]),
        box_start=(start[0], start[1], start[2]),
        box_stop=(stop[0], stop[1], stop[2]),
        on_walls=frozenset((wall.axis, wall.sign) for wall in walls),
        mirrored=mirrored,
    )


def _axis(
    body: Body,
    axis: int,
    spacing_m: float,
    walls: dict[int, float],
    box_margin_m: float,
    cells_per_unit: int,
) -> tuple[Array, int, int]:
    """Planes of faces across an axis, and the first and last one of the box."""
    lower, upper = (float(corner[axis]) for corner in body.bounds())
    unit_m = cells_per_unit * spacing_m
    planes = _planes(body, axis, unit_m, walls)
    if not planes:
        planes = [(lower + upper) / 2.0]
    parts = [np.array(planes[:1])]
    for low, high in itertools.pairwise(planes):
        count = cells_per_unit * max(1, int(np.ceil((high - low) / unit_m - _STRETCH)))
        parts.append(np.linspace(low, high, count + 1)[1:])
    line = np.concatenate(parts)
    margin = max(box_margin_m, _BOX_MARGIN_CELLS * spacing_m)
    beyond = PML_CELLS + _GAP_CELLS
    before = after = 0
    if -1 not in walls:
        before = max(0, int(np.ceil((line[0] - lower + margin) / spacing_m - 1e-9)))
        count = before + beyond
        line = np.concatenate([line[0] - spacing_m * np.arange(count, 0, -1), line])
    if 1 not in walls:
        after = max(0, int(np.ceil((upper + margin - line[-1]) / spacing_m - 1e-9)))
        line = np.concatenate([line, line[-1] + spacing_m * np.arange(1, after + beyond + 1)])
    start = 0 if -1 in walls else beyond
    return line, start, line.size - 1 - (0 if 1 in walls else beyond)


def _planes(body: Body, axis: int, unit_m: float, walls: dict[int, float]) -> list[float]:
    """Walls, and plane faces of the body from the largest down, unless they crowd; rising."""
    chosen = list(walls.values())
    for plane in body.flats(axis, 0.1 * unit_m**2):
        if plane > walls.get(-1, -np.inf) and all(
            abs(plane - other) >= _CLOSEST_PLANES * unit_m for other in chosen
        ):
            chosen.append(float(plane))
    return sorted(chosen)
