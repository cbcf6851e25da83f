"""What the moving surface pushes into each wall cell of the machine side's grid."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial import cKDTree

from .arrays import Array, IndexArray
from .cut_cells import CutCells
from .near_grid import NearGrid
from .patterns import Pattern
from .surface_points import SurfacePoints

_SLIDING: Final = 0.03
"""A wall that nowhere moves more than this share across itself slides: facets lean by 1.4°."""


def wall_fluxes(
    cells: CutCells, grid: NearGrid, surface: Iterable[SurfacePoints], patterns: Sequence[Pattern]
) -> Array:
    """Volume velocity out of each wall cell's fluid into the wall, m³/s, (pattern, wall).

    Per unit velocity of each pattern; zero everywhere when the wall only slides along itself. Each
    cell's mean velocity acts on its wall area as the open faces leave it, so that uniform motion
    makes no noise; what the velocity varies within the cell is summed over the surface itself.
    Errors of the flux matter most to patterns that have no volume velocity and no dipole moment:
    they drown their weak sound at low frequencies. The sum is made exact.

    The surface's points come in parts, so that not all of them need be kept.
    """
    number = cells.wall_cells.size
    middles = cKDTree(grid.middles(cells.wall_cells))
    area, area_vectors = np.zeros(number), np.zeros((number, 3))
    sums = [_Sums(np.zeros((number, 3)), np.zeros(number)) for _ in patterns]
    for points in surface:
        wall = _wall_pieces(cells, grid, middles, points)
        area += np.bincount(wall, points.area, number)
        area_vectors += _by_piece(wall, points.area[:, None] * points.normal, number)
        for pattern, own in zip(patterns, sums, strict=True):
            own.add(pattern.velocity(points), points, wall)
    nearest = _nearest_with_points(middles, area)
    return np.array([own.flux(cells.wall_areas, area, area_vectors, nearest) for own in sums])


@dataclass
class _Sums:
    """Sums of one pattern's velocity over the surface's points in each wall piece."""

    velocity: Array
    """Area times velocity, m³/s, (wall, 3)."""
    across: Array
    """Area times velocity out of the body, m³/s, (wall,)."""
    fastest: float = 0.0
    fastest_across: float = 0.0

    def add(self, velocity: Array, points: SurfacePoints, wall: IndexArray) -> None:
        """Add the points (point,) with their velocities (point, 3) and wall pieces."""
        across = np.einsum("pi,pi->p", velocity, points.normal)
        number = self.across.size
        self.velocity += _by_piece(wall, points.area[:, None] * velocity, number)
        self.across += np.bincount(wall, points.area * across, number)
        self.fastest = max(self.fastest, float(np.linalg.norm(velocity, axis=1).max(initial=0.0)))
        self.fastest_across = max(self.fastest_across, float(np.abs(across).max(initial=0.0)))

    def flux(
        self, wall_areas: Array, area: Array, area_vectors: Array, nearest: IndexArray
    ) -> Array:
        """Flux (wall,): the mean velocity on the wall areas of the grid, and what varies."""
        if self.fastest_across <= _SLIDING * self.fastest:
            return np.zeros(area.size)
        own = self.velocity / np.maximum(area, np.finfo(float).tiny)[:, None]
        varying = self.across - np.einsum("wi,wi->w", own, area_vectors)
        mean = own[nearest]
        flux = np.einsum("wi,wi->w", mean, wall_areas) - varying
        moving = np.linalg.norm(mean, axis=1) * np.linalg.norm(wall_areas, axis=1)
        excess = flux.sum() + self.across.sum()
        corrected: Array = flux - excess * moving / moving.sum()
        return corrected


def _wall_pieces(
    cells: CutCells, grid: NearGrid, middles: cKDTree, points: SurfacePoints
) -> IndexArray:
    """Wall piece of the cell on the fluid's side of each point, or the nearest one, (point,).

    A cell that is all but solid may have no piece of wall.
    """
    cell = grid.cells_at(points.position + 1e-3 * grid.spacing_m * points.normal)
    wall: IndexArray = np.searchsorted(cells.wall_cells, cell)
    wall[wall == cells.wall_cells.size] = 0
    lost = cells.wall_cells[wall] != cell
    wall[lost] = middles.query(points.position[lost])[1]
    return wall


def _nearest_with_points(middles: cKDTree, area: Array) -> IndexArray:
    """Wall piece that has points, next to each wall piece: itself where it has some, (wall,)."""
    filled = np.flatnonzero(area)
    empty = np.flatnonzero(area == 0.0)
    nearest: IndexArray = np.arange(area.size)
    nearest[empty] = filled[cKDTree(middles.data[filled]).query(middles.data[empty])[1]]
    return nearest


def _by_piece(wall: IndexArray, values: Array, number: int) -> Array:
    """Sums of values (point, n) over each wall piece, (wall, n)."""
    return np.stack([np.bincount(wall, part, number) for part in values.T], axis=1)
