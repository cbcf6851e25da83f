"""The second method's grid: cells of a room, its solid ones, and the faces where air ends."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vibroacoustics.radiation.arrays import Array, IndexArray
from vibroacoustics.radiation.rooms.room import Material, Room


@dataclass(frozen=True)
class WallFaces:
    """Faces of cells of one material across one axis."""

    axis: int
    material: Material
    cells: IndexArray
    """Flat index, in the padded grid, of the cell in front of each face."""


@dataclass(frozen=True)
class LocalGrid:
    """Cells that fill the room; blocks take those whose middle they hold."""

    edges: tuple[Array, Array, Array]
    air: NDArray[np.bool_]
    """(x, y, z), with a row of solid cells all around."""
    walls: tuple[WallFaces, ...]

    @property
    def spacing(self) -> Array:
        """Along each axis, m."""
        return np.array([line[1] - line[0] for line in self.edges])

    def weights(self, point: Array) -> tuple[IndexArray, Array]:
        """Cells around a point, flat in the padded grid, and their shares: linear between them.

        Cells in solids are left out, and the others take their share.
        """
        cells: list[IndexArray] = []
        shares: list[Array] = []
        for axis, line in enumerate(self.edges):
            at = np.clip((point[axis] - line[0]) / self.spacing[axis] - 0.5, 0.0, line.size - 2.0)
            low = min(int(at), max(line.size - 3, 0))
            cells.append(np.array([low + 1, low + 2]))
            shares.append(np.array([1.0 - (at - low), at - low]))
        index = np.ravel_multi_index(np.ix_(*cells), self.air.shape).ravel()
        share = np.einsum("i,j,k->ijk", *shares).ravel() * self.air.ravel()[index]
        return index, share / share.sum()


def local_grid(room: Room, spacing_m: float) -> LocalGrid:
    """The grid of a room, as coarse as the spacing allows."""
    counts = [max(1, int(np.ceil(size / spacing_m - 1e-6))) for size in room.size_m]
    edges = [np.linspace(0.0, size, n + 1) for size, n in zip(room.size_m, counts, strict=True)]
    middles = [(line[1:] + line[:-1]) / 2.0 for line in edges]
    air = np.ones(counts, dtype=bool)
    for block in room.blocks:
        held = [
            (middle > low) & (middle < high)
            for middle, low, high in zip(middles, block.lower, block.upper, strict=True)
        ]
        air &= ~np.einsum("i,j,k->ijk", *held)
    padded = np.pad(air, 1)
    walls = [
        wall
        for axis in range(3)
        for end in (0, 1)
        for wall in _walls(room, edges, padded, axis, end)
    ]
    return LocalGrid((edges[0], edges[1], edges[2]), padded, tuple(walls))


def _walls(
    room: Room, edges: list[Array], air: NDArray[np.bool_], axis: int, end: int
) -> list[WallFaces]:
    ends = np.argwhere(air & ~np.roll(air, -1 if end else 1, axis=axis))
    by_material: dict[Material, list[IndexArray]] = {}
    for cell in ends:
        point = np.array([(edges[a][cell[a] - 1] + edges[a][cell[a]]) / 2.0 for a in range(3)])
        material = _behind(room, point, axis, end, float(edges[axis][cell[axis] - 1 + end]))
        if not material.hard:
            by_material.setdefault(material, []).append(cell)
    return [
        WallFaces(axis, material, np.ravel_multi_index(tuple(np.array(cells).T), air.shape))
        for material, cells in by_material.items()
    ]


def _behind(room: Room, cell: Array, axis: int, end: int, level: float) -> Material:
    """Material behind a face of a cell: of the room's side, or of the block that takes the next."""
    point = cell.copy()
    point[axis] = level
    width = abs(level - cell[axis])
    if width < level < room.size_m[axis] - width:  # the next cell's middle lies in the block
        point[axis] += width if end else -width
    material = room.material(axis, end, point)
    assert material is not None  # air cells are told apart before
    return material
