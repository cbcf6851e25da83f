"""Cut cells: how the wall of a body divides the cells of a uniform staggered grid.

Every quantity comes from the signed distance on sub-samples. A sub-sample of size h counts as fluid
by the share clip(1/2 + d/h, 0, 1), which is exact for walls along the grid.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from .arrays import Array, IndexArray
from .bodies import Body

_SAMPLES: Final = 8
"""Sub-samples along each edge of a cell."""
_SMALLEST_VOLUME_PER_AREA: Final = 1.0 / 18.0
"""Lower bound of the volume fraction over the sum of open-area fractions, for stability.

With it every run at a Courant number of 0.3 or less was stable; there is no proof.
"""
_CHUNK_CELLS: Final = 4000


@dataclass(frozen=True)
class CutCells:
    """Geometry of the fluid in the grid; fractions of a face or cell, areas in m²."""

    open_areas: tuple[Array, Array, Array]
    """Open fraction of all faces across each axis, one more than cells along that axis."""
    volumes: Array
    """Fluid fraction of each cell, bounded below; 0 in cells without an open face."""
    fluid_volumes: Array
    """Fluid fraction of each cell, not bounded."""
    wall_cells: IndexArray
    """Flat indices of the cells that hold a piece of wall, (wall,)."""
    wall_areas: Array
    """Vector areas of the wall pieces, out of the fluid, m², (wall, 3)."""
    wall_centroids: Array
    """Points on the wall pieces, m, (wall, 3)."""


def cut_cells(body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int]) -> CutCells:
    """Cut the grid of the given lower corner, spacing and number of cells by a body.

    The lowest z faces are sampled just above their plane, so that they are closed under a body
    that stands on them.
    """
    open_areas = (
        _open_fractions(body, origin, spacing_m, shape, 0),
        _open_fractions(body, origin, spacing_m, shape, 1),
        _open_fractions(body, origin, spacing_m, shape, 2),
    )
    fluid_volumes = _volume_fractions(body, origin, spacing_m, shape)
    total_area = sum(
        area[_lower(axis)] + area[_upper(axis)] for axis, area in enumerate(open_areas)
    )
    # The divergence theorem: the faces and the wall of a cell's fluid together have no vector area.
    wall = np.stack(
        [area[_lower(axis)] - area[_upper(axis)] for axis, area in enumerate(open_areas)], axis=-1
    ).reshape(-1, 3)
    wall_cells = np.flatnonzero(np.any(np.abs(wall) > 1e-12, axis=1))
    return CutCells(
        open_areas=open_areas,
        volumes=np.maximum(
            fluid_volumes * (total_area > 0), total_area * _SMALLEST_VOLUME_PER_AREA
        ),
        fluid_volumes=fluid_volumes,
        wall_cells=wall_cells,
        wall_areas=wall[wall_cells] * spacing_m**2,
        wall_centroids=_wall_centroids(body, origin, spacing_m, shape, wall_cells),
    )


def _lower(axis: int) -> tuple[slice, ...]:
    return tuple(slice(None, -1) if other == axis else slice(None) for other in range(3))


def _upper(axis: int) -> tuple[slice, ...]:
    return tuple(slice(1, None) if other == axis else slice(None) for other in range(3))


def _centres(origin: Array, spacing_m: float, shape: tuple[int, ...], offset: Array) -> Array:
    """Points of a regular grid, flat (point, 3); `offset` is the first point in cells."""
    axes = [
        low + spacing_m * (np.arange(count) + shift)
        for low, count, shift in zip(origin, shape, offset, strict=True)
    ]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _offsets(spacing_m: float, axes: tuple[int, ...]) -> Array:
    """Sub-sample offsets from the middle of a cell, spread along the given axes, (sample, 3)."""
    ticks = spacing_m * ((np.arange(_SAMPLES) + 0.5) / _SAMPLES - 0.5)
    spread = [ticks if axis in axes else np.zeros(1) for axis in range(3)]
    return np.stack(np.meshgrid(*spread, indexing="ij"), axis=-1).reshape(-1, 3)


def _fluid_fraction(body: Body, points: Array, offsets: Array, spacing_m: float) -> Array:
    """Share of fluid in the sub-samples around each point."""
    distance = body.signed_distance(points)
    fraction = (distance > 0).astype(float)
    # Further off than half a cell's diagonal nothing is cut.
    near = np.flatnonzero(np.abs(distance) < spacing_m)
    sample_m = spacing_m / _SAMPLES
    for chunk in _chunks(near):
        samples = body.signed_distance(points[chunk, None, :] + offsets)
        fraction[chunk] = np.clip(0.5 + samples / sample_m, 0.0, 1.0).mean(axis=1)
    return fraction


def _chunks(indices: IndexArray) -> list[IndexArray]:
    return np.array_split(indices, max(1, -(-indices.size // _CHUNK_CELLS)))


def _open_fractions(
    body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int], axis: int
) -> Array:
    faces = tuple(count + (other == axis) for other, count in enumerate(shape))
    offset = np.full(3, 0.5)
    offset[axis] = 0.0
    points = _centres(origin, spacing_m, faces, offset)
    if axis == 2:
        points.reshape(*faces, 3)[:, :, 0, 2] += 0.5 * spacing_m / _SAMPLES
    across = tuple(other for other in range(3) if other != axis)
    return _fluid_fraction(body, points, _offsets(spacing_m, across), spacing_m).reshape(faces)


def _volume_fractions(
    body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int]
) -> Array:
    points = _centres(origin, spacing_m, shape, np.full(3, 0.5))
    return _fluid_fraction(body, points, _offsets(spacing_m, (0, 1, 2)), spacing_m).reshape(shape)


def _wall_centroids(
    body: Body, origin: Array, spacing_m: float, shape: tuple[int, int, int], cells: IndexArray
) -> Array:
    """Mean of the sub-samples within one sub-sample of the wall; else the cell's middle."""
    middles = origin + spacing_m * (np.stack(np.unravel_index(cells, shape), axis=-1) + 0.5)
    offsets = _offsets(spacing_m, (0, 1, 2))
    sample_m = spacing_m / _SAMPLES
    centroids = middles.copy()
    for chunk in _chunks(np.arange(cells.size)):
        samples = middles[chunk, None, :] + offsets
        weights = np.maximum(1.0 - np.abs(body.signed_distance(samples)) / sample_m, 0.0)
        total = weights.sum(axis=1)
        found = total > 0
        mean = np.einsum("cs,csi->ci", weights, samples)[found] / total[found, None]
        centroids[chunk[found]] = mean
    return centroids
