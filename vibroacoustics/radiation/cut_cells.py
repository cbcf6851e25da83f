"""Cut cells: the wall of a body divides the cells of a staggered grid; the end of a run."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from .arrays import Array, ComplexArray, IndexArray
from .bodies import Body
from .lines import fluid_on_lines
from .near_grid import COURANT_NUMBER, MOST_OPEN, NearGrid
from .symmetry import both_halves, images

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


GEOMETRY_BYTES_PER_CELL: Final = 32
"""Three open areas and a volume in double precision."""
_LINES_PER_FACE: Final = 100
_LINES_PER_CELL: Final = (16, 16)
_BESIDE_FACE: Final = 1e-4
"""A face is cut by both planes at this share of a cell beside it, and the smaller opening counts.

So a wall that lies in a plane of faces closes them, whichever side it is on.
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


def cut_cells(body: Body, grid: NearGrid) -> CutCells:
    """Cut the cells of a grid by a body; along mirrored axes the one half is the other's image."""
    upper = grid.upper_half
    start, stop = _around(body, upper)
    part = [edges[a : b + 1] for edges, a, b in zip(upper.edges, start, stop, strict=True)]
    open_areas: list[Array] = []
    for axis in range(3):
        shape = [count + (other == axis) for other, count in enumerate(upper.shape)]
        area = np.ones(shape)
        area[
            tuple(
                slice(a, b + (i == axis)) for i, (a, b) in enumerate(zip(start, stop, strict=False))
            )
        ] = _open_fractions(body, part, axis)
        open_areas.append(area)
    volumes: Array = np.ones(upper.shape)
    volumes[tuple(map(slice, start, stop))] = _volume_fractions(body, part)
    both_faces: list[Array] = [
        area[_lower(axis)] + area[_upper(axis)] for axis, area in enumerate(open_areas)
    ]
    total_area: Array = np.sum(both_faces, axis=0)
    smallest = _smallest_volumes(both_faces, grid)
    volumes = np.where(total_area > 0, np.maximum(volumes, smallest), 0.0)
    wall = _wall_areas(open_areas, upper)
    has_wall = np.any(np.abs(wall) > 1e-12 * grid.spacing_m**2, axis=1) & (total_area.ravel() > 0)
    wall_cells = np.flatnonzero(both_halves(has_wall.reshape(upper.shape), grid.mirrored))
    image, beyond = images(wall_cells, grid.shape, grid.mirrored)
    wall_areas = wall[image]
    for axis, across in zip(grid.mirrored, beyond, strict=True):
        wall_areas[across, axis] *= -1.0
    x, y, z = (both_halves(area, grid.mirrored, axis) for axis, area in enumerate(open_areas))
    return CutCells((x, y, z), both_halves(volumes, grid.mirrored), wall_cells, wall_areas)


def _smallest_volumes(open_areas: list[Array], grid: NearGrid) -> Array:
    """Lower bound of the cells' fluid fractions, for stability, from the areas by axis."""
    upper = grid.upper_half
    total = np.zeros(upper.shape)
    for axis, area in enumerate(open_areas):
        shape = [-1 if other == axis else 1 for other in range(3)]
        total += area * upper.stiffness(axis).reshape(shape)
    return np.asarray(total * (grid.courant_number / COURANT_NUMBER) ** 2 / MOST_OPEN)


def _wall_areas(open_areas: list[Array], grid: NearGrid) -> Array:
    """Vector area of the wall in each cell, out of the fluid, m², (cell, 3).

    The divergence theorem: faces and wall of a cell's fluid together have no vector area.
    """
    parts = []
    for axis, area in enumerate(open_areas):
        first, second = [other for other in range(3) if other != axis]
        face = np.multiply.outer(grid.widths(first), grid.widths(second))
        parts.append((area[_lower(axis)] - area[_upper(axis)]) * np.expand_dims(face, axis))
    return np.stack(parts, axis=-1).reshape(-1, 3)


def _around(body: Body, grid: NearGrid) -> tuple[list[int], list[int]]:
    """First and last cell, by axis, of the part of the grid that holds the body."""
    lower, upper = body.bounds()
    start, stop = [], []
    for edges, low, high in zip(grid.edges, lower, upper, strict=True):
        start.append(max(0, int(np.searchsorted(edges, low)) - 2))
        stop.append(min(edges.size - 1, int(np.searchsorted(edges, high)) + 1))
    return start, stop


def _lower(axis: int) -> tuple[slice, ...]:
    return tuple(slice(None, -1) if other == axis else slice(None) for other in range(3))


def _upper(axis: int) -> tuple[slice, ...]:
    return tuple(slice(1, None) if other == axis else slice(None) for other in range(3))


def _lines(edges: Array, per_cell: int) -> Array:
    """Coordinates of the lines of consecutive cells on one axis."""
    shares = (np.arange(per_cell) + 0.5) / per_cell
    return np.asarray((edges[:-1, None] + np.diff(edges)[:, None] * shares).ravel())


def _open_fractions(body: Body, edges: list[Array], axis: int) -> Array:
    along, across = (axis + 1) % 3, (axis + 2) % 3
    lines = _lines(edges[across], _LINES_PER_FACE)
    shift = _BESIDE_FACE * np.diff(edges[axis]).min()
    beside = [
        fluid_on_lines(
            body, along, (lines, edges[axis] + side * shift), (_LINES_PER_FACE, 1), edges[along]
        )
        for side in (-1, 1)
    ]
    return _from_axes(np.minimum(*beside), (across, axis, along))


def _volume_fractions(body: Body, edges: list[Array]) -> Array:
    first, second = (
        _lines(line, per_cell) for line, per_cell in zip(edges, _LINES_PER_CELL, strict=False)
    )
    return fluid_on_lines(body, 2, (first, second), _LINES_PER_CELL, edges[2])


def _from_axes(values: Array, axes: tuple[int, int, int]) -> Array:
    """Array whose dimensions are the given axes, in the order x, y, z."""
    return values.transpose(np.argsort(axes))
