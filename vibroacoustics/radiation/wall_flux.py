"""Flux of the moving surface into each wall cell of the machine side's grid."""

from collections.abc import Iterable, Sequence
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
    they drown their weak sound at low frequencies. So the sum is made exact, and the dipole that
    comes from the cells' middles lying beside the surface is taken off.

    The surface's points come in parts, so that not all of them need be kept.
    """
    middles = grid.middles(cells.wall_cells)
    tree = cKDTree(middles)
    wall = _Wall(cells)
    sums = [_Sums(cells.wall_cells.size) for _ in patterns]
    for points in surface:
        piece = _wall_pieces(cells, grid, tree, points)
        offset = middles[piece] - points.position
        offset -= np.einsum("pi,pi->p", offset, points.normal)[:, None] * points.normal
        velocities = [pattern.velocity(points) for pattern in patterns]
        wall.add(points, piece, np.any(velocities, axis=(0, 2)))
        for pattern_sums, velocity in zip(sums, velocities, strict=True):
            pattern_sums.add(velocity, points, piece, offset)
    nearest = _nearest_with_points(tree, wall.area)
    return np.array([pattern_sums.flux(wall, nearest) for pattern_sums in sums])


class _Wall:
    """Sums over the surface's points in each wall piece, whatever moves."""

    def __init__(self, cells: CutCells) -> None:
        number = cells.wall_cells.size
        self.areas: Array = cells.wall_areas
        self.area = np.zeros(number)
        self.area_vectors = np.zeros((number, 3))
        self.moving_area = np.zeros(number)
        self._volumes = np.zeros(3)

    def add(self, points: SurfacePoints, piece: IndexArray, moving: Array) -> None:
        """Add points (point,) with their wall pieces; `moving` says which of them ever move."""
        number = self.area.size
        self.area += np.bincount(piece, points.area, number)
        self.area_vectors += _by_piece(piece, points.area[:, None] * points.normal, number)
        self.moving_area += np.bincount(piece, points.area * moving, number)
        self._volumes += (points.area * moving) @ (points.normal * points.position)

    def translation_flux(self) -> Array:
        """Flux of the moving part's unit translations along x, y, z, (wall, 3)."""
        share = self.moving_area / np.maximum(self.area, np.finfo(float).tiny)
        return np.asarray(share[:, None] * self.areas)

    def volume(self) -> float:
        """Volume of what moves: three ways to it by the divergence theorem.

        A face on a wall of the room is missing in one of them, which is smaller by that.
        """
        return float(self._volumes.max())


class _Sums:
    """Sums of one pattern's velocity over the surface's points in each wall piece."""

    def __init__(self, number: int) -> None:
        self._velocity = np.zeros((number, 3))
        self._across = np.zeros(number)
        self._moment = np.zeros(3)
        self._fastest = self._fastest_across = 0.0

    def add(self, velocity: Array, points: SurfacePoints, piece: IndexArray, offset: Array) -> None:
        """Add points (point,) with velocities, wall pieces and offsets of these along the wall."""
        across = np.einsum("pi,pi->p", velocity, points.normal)
        number = self._across.size
        self._velocity += _by_piece(piece, points.area[:, None] * velocity, number)
        self._across += np.bincount(piece, points.area * across, number)
        self._moment += (points.area * across) @ offset
        fastest = np.linalg.norm(velocity, axis=1).max(initial=0.0)
        self._fastest = max(self._fastest, float(fastest))
        self._fastest_across = max(self._fastest_across, float(np.abs(across).max(initial=0.0)))

    def flux(self, wall: _Wall, nearest: IndexArray) -> Array:
        """Flux (wall,): the mean velocity on the wall areas of the grid, and what varies."""
        if self._fastest_across <= _SLIDING * self._fastest:
            return np.zeros(wall.area.size)
        mean_velocity = self._velocity / np.maximum(wall.area, np.finfo(float).tiny)[:, None]
        varying = self._across - np.einsum("wi,wi->w", mean_velocity, wall.area_vectors)
        mean = mean_velocity[nearest]
        flux = np.einsum("wi,wi->w", mean, wall.areas) - varying
        flux -= wall.translation_flux() @ self._moment / wall.volume()
        moving = np.linalg.norm(mean, axis=1) * np.linalg.norm(wall.areas, axis=1)
        excess = flux.sum() + self._across.sum()
        return np.asarray(flux - excess * moving / moving.sum())


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
