"""Points all over a body's surface, each with its share of the area."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import Array, IndexArray
from .bodies import Body


@dataclass(frozen=True)
class SurfacePoints:
    """Middles of small pieces of the surface."""

    position: Array
    """(point, 3), m."""
    normal: Array
    """Unit normals out of the body, (point, 3)."""
    area: Array
    """(point,), m²."""
    face: IndexArray
    """The triangle of the body that each point lies on, (point,)."""
    weights: Array
    """Share of the triangle's three corners, (point, 3)."""

    def where(self, conditions: Sequence[NDArray[np.bool_]]) -> "SurfacePoints":
        """Points that meet every condition (point,)."""
        chosen = np.all([np.ones(self.area.size, dtype=bool), *conditions], axis=0)
        return SurfacePoints(
            *(getattr(self, field.name)[chosen] for field in dataclasses.fields(self))
        )


def surface_points(body: Body, largest_m: float) -> SurfacePoints:
    """Pieces of at most `largest_m` a side: strips along each triangle's shortest edge, divided.

    Strips from apex to base and equal parts of each, seen from the apex, so that slivers are not
    cut finer than they need be; a point is the centroid of its piece.
    """
    faces, weights, shares = [], [], []
    triangles = body.triangles
    # Edge i is opposite of corner i; the apex is opposite of the shortest.
    edges = np.linalg.norm(np.roll(triangles, -1, axis=1) - np.roll(triangles, 1, axis=1), axis=2)
    apex = edges.argmin(axis=1)
    numbers = np.ceil(np.stack([edges.max(axis=1), edges.min(axis=1)]) / largest_m).astype(int)
    for strips, parts in np.unique(numbers, axis=1).T:
        chosen = np.flatnonzero((numbers[0] == strips) & (numbers[1] == parts))
        weight, share = _pieces(max(strips, 1), max(parts, 1))
        # Weights belong to apex and the two corners after it.
        corner = (np.arange(3) - apex[chosen, None]) % 3
        faces.append(np.repeat(chosen, share.size))
        weights.append(weight[:, corner].swapaxes(0, 1).reshape(-1, 3))
        shares.append(np.tile(share, chosen.size))
    face, weight = np.concatenate(faces), np.concatenate(weights)
    areas = body.area_vectors()
    size = np.linalg.norm(areas, axis=1)
    return SurfacePoints(
        position=np.einsum("pk,pki->pi", weight, triangles[face]),
        normal=areas[face] / np.maximum(size[face], np.finfo(float).tiny)[:, None],
        area=size[face] * np.concatenate(shares),
        face=face,
        weights=weight,
    )


def _pieces(strips: int, parts: int) -> tuple[Array, Array]:
    """Centroids as shares of apex and base corners, (piece, 3), and shares of the area, (piece,)."""
    ends = np.arange(strips + 1) / strips
    area = ends[1:] ** 2 - ends[:-1] ** 2
    depth = np.repeat(2.0 / 3.0 * (ends[1:] ** 3 - ends[:-1] ** 3) / area, parts)
    along = np.tile((np.arange(parts) + 0.5) / parts, strips)
    weights = np.stack([1.0 - depth, depth * (1.0 - along), depth * along], axis=1)
    return weights, np.repeat(area, parts) / parts
