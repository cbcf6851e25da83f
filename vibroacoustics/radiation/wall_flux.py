"""What the moving surface pushes into each wall cell of the machine side's grid."""

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


@dataclass(frozen=True)
class WallPoints:
    """Which points of the surface lie on which wall piece."""

    points: SurfacePoints
    wall: IndexArray
    """Wall piece of each point, (point,)."""
    like: IndexArray
    """Wall piece that has points, next to each wall piece: itself where it has some, (wall,)."""

    def mean(self, values: Array) -> Array:
        """Mean of values (point, n) over each wall piece, (wall, n)."""
        number = self.like.size
        area = np.bincount(self.wall, self.points.area, number)
        sums = [np.bincount(self.wall, self.points.area * part, number) for part in values.T]
        means: Array = np.stack(sums, axis=1) / np.maximum(area, np.finfo(float).tiny)[:, None]
        return means[self.like]


def wall_points(cells: CutCells, points: SurfacePoints, grid: NearGrid) -> WallPoints:
    """Wall piece of the cell on the fluid's side of each point, or the nearest one.

    A cell that is all but solid may have no piece of wall, and a small piece no point.
    """
    cell = grid.cells_at(points.position + 1e-3 * grid.spacing_m * points.normal)
    wall = np.searchsorted(cells.wall_cells, cell)
    wall[wall == cells.wall_cells.size] = 0
    lost = cells.wall_cells[wall] != cell
    middles = grid.middles(cells.wall_cells)
    wall[lost] = cKDTree(middles).query(points.position[lost])[1]
    number = cells.wall_cells.size
    filled = np.flatnonzero(np.bincount(wall, minlength=number))
    like = np.arange(number)
    empty = np.setdiff1d(like, filled)
    like[empty] = filled[cKDTree(middles[filled]).query(middles[empty])[1]]
    return WallPoints(points, wall, like)


def wall_flux(cells: CutCells, surface: WallPoints, pattern: Pattern) -> Array:
    """Volume velocity out of each wall cell's fluid into the wall, m³/s, (wall,).

    Per unit velocity of the pattern; zero everywhere when the wall only slides along itself. Each
    cell's mean velocity acts on its wall area as the open faces leave it, so that uniform motion
    makes no noise; what the velocity varies within the cell is summed over the surface itself.
    Errors of the flux matter most to patterns that have no volume velocity and no dipole moment:
    they drown their weak sound at low frequencies. The sum is made exact.
    """
    points = surface.points
    velocity = pattern.velocity(points)
    normal = np.einsum("pi,pi->p", velocity, points.normal)
    number = cells.wall_cells.size
    if np.abs(normal).max() <= _SLIDING * np.linalg.norm(velocity, axis=1).max():
        return np.zeros(number)
    mean = surface.mean(velocity)
    varying = np.einsum("pi,pi->p", velocity - mean[surface.wall], points.normal)
    flux = np.einsum("wi,wi->w", mean, cells.wall_areas)
    flux -= np.bincount(surface.wall, points.area * varying, number)
    moving = np.linalg.norm(mean, axis=1) * np.linalg.norm(cells.wall_areas, axis=1)
    excess = flux.sum() + points.area @ normal
    corrected: Array = flux - excess * moving / moving.sum()
    return corrected
