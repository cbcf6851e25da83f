"""Cut cells: how the wall of a body divides the cells of a uniform staggered grid.

Areas and volumes are means over parallel lines through the body, exact along each line.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from .arrays import Array, IndexArray
from .bodies import Body
from .lines import fluid_on_lines

_LINES_PER_FACE: Final = 100
_LINES_PER_CELL: Final = (16, 16)
_BESIDE_FACE: Final = 1e-4
"""A face is cut by both planes at this share of a cell beside it, and the smaller opening counts.

So a wall that lies in a plane of faces closes them, whichever side it is on.
"""
_SMALLEST_VOLUME_PER_AREA: Final = 1.0 / 18.0
"""Lower bound of the volume fraction over the sum of open-area fractions, for stability.

With it every run at a Courant number of 0.3 or less was stable; there is no proof.
"""


@dataclass(frozen=True)
class CutCells:
    """Geometry of the fluid in the grid; fractions of a face or cell, areas in m²."""

    open_areas: tuple[Array, Array, Array]
    """Open fraction of all faces across each axis, one more than cells along that axis."""
    volumes: Array
    """Fluid fraction of each cell, bounded below; 0 in cells without an open face."""
    wall_cells: IndexArray
    """Flat indices of the cells that hold a piece of wall, (wall,)."""
    wall_areas: Array
    """Vector areas of the wall pieces, out of the fluid, m², (wall, 3)."""


def cut_cells(body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int]) -> CutCells:
    """Cut the grid of the given lower corner, spacing and number of cells by a body.

    Raises
    ------
    ParameterError
        The surface of the body is open.
    """
    near, start, stop = _around(body, origin, spacing_m, shape)
    open_areas = [np.ones([n + (other == axis) for other, n in enumerate(shape)]) for axis in range(3)]
    for axis, area in enumerate(open_areas):
        faces = tuple(slice(a, b + (other == axis)) for other, (a, b) in enumerate(zip(start, stop)))
        area[faces] = _open_fractions(body, near, spacing_m, stop - start, axis)
    volumes = np.ones(shape)
    volumes[tuple(map(slice, start, stop))] = _volume_fractions(body, near, spacing_m, stop - start)
    total_area = sum(
        area[_lower(axis)] + area[_upper(axis)] for axis, area in enumerate(open_areas)
    )
    # The divergence theorem: the faces and the wall of a cell's fluid together have no vector area.
    wall = np.stack(
        [area[_lower(axis)] - area[_upper(axis)] for axis, area in enumerate(open_areas)], axis=-1
    ).reshape(-1, 3)
    wall_cells = np.flatnonzero(np.any(np.abs(wall) > 1e-12, axis=1) & (total_area.ravel() > 0))
    return CutCells(
        open_areas=(open_areas[0], open_areas[1], open_areas[2]),
        volumes=np.maximum(volumes * (total_area > 0), total_area * _SMALLEST_VOLUME_PER_AREA),
        wall_cells=wall_cells,
        wall_areas=wall[wall_cells] * spacing_m**2,
    )


def _around(
    body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int]
) -> tuple[Array, IndexArray, IndexArray]:
    """Lower corner, first and last cell of the part of the grid that holds the body."""
    lower, upper = body.bounds()
    start = np.clip(np.floor((lower - origin) / spacing_m).astype(int) - 1, 0, None)
    stop = np.minimum(np.ceil((upper - origin) / spacing_m).astype(int) + 1, shape)
    return origin + spacing_m * start, start, stop


def _lower(axis: int) -> tuple[slice, ...]:
    return tuple(slice(None, -1) if other == axis else slice(None) for other in range(3))


def _upper(axis: int) -> tuple[slice, ...]:
    return tuple(slice(1, None) if other == axis else slice(None) for other in range(3))


def _lines(low: float, spacing_m: float, cells: int, per_cell: int) -> Array:
    """Coordinates of the lines of consecutive cells on one axis."""
    coordinates: Array = low + spacing_m * (np.arange(cells * per_cell) + 0.5) / per_cell
    return coordinates


def _open_fractions(
    body: Body, origin: Array, spacing_m: float, shape: IndexArray, axis: int
) -> Array:
    along, across = (axis + 1) % 3, (axis + 2) % 3
    lines = _lines(origin[across], spacing_m, shape[across], _LINES_PER_FACE)
    planes = origin[axis] + spacing_m * np.arange(shape[axis] + 1)
    beside = [
        fluid_on_lines(
            body,
            along,
            (lines, planes + shift * spacing_m),
            (_LINES_PER_FACE, 1),
            origin[along],
            spacing_m,
            shape[along],
        )
        for shift in (-_BESIDE_FACE, _BESIDE_FACE)
    ]
    return _from_axes(np.minimum(*beside), (across, axis, along))


def _volume_fractions(body: Body, origin: Array, spacing_m: float, shape: IndexArray) -> Array:
    across = [
        _lines(origin[axis], spacing_m, shape[axis], per_cell)
        for axis, per_cell in enumerate(_LINES_PER_CELL)
    ]
    fluid = fluid_on_lines(
        body, 2, (across[0], across[1]), _LINES_PER_CELL, origin[2], spacing_m, shape[2]
    )
    return fluid


def _from_axes(values: Array, axes: tuple[int, int, int]) -> Array:
    """Array whose dimensions are the given axes, in the order x, y, z."""
    return values.transpose(np.argsort(axes))
