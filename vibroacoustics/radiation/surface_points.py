"""Points all over a body's surface, each with its share of the area."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .arrays import Array, IndexArray
from .bodies import Body

POINTS_AT_A_TIME: Final = 50_000
"""Points of a part of the surface, about; a face is never shared by two parts."""
_THREE_POINTS: Final = np.full((3, 3), 1.0 / 6.0) + np.eye(3) / 2.0
"""Shares of a triangle's corners in three points of equal weight, exact for quadratics."""
_POINTS_PER_PATCH: Final = 18
"""Points of a face per pair of planes through it, at most, of a cylinder's slender triangles."""


@dataclass(frozen=True)
class SurfacePoints:
    """Three points on each of many small pieces of the surface."""

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


def surface_in_parts(body: Body, planes: tuple[Array, Array, Array]) -> Iterator[SurfacePoints]:
    """All points of the surface, `POINTS_AT_A_TIME` or so at a time."""
    x, y, z = (
        1 + np.ptp(np.searchsorted(across, body.triangles[:, :, axis]), axis=1)
        for axis, across in enumerate(planes)
    )
    points = np.cumsum(_POINTS_PER_PATCH * (x * y + y * z + z * x))
    ends = np.searchsorted(points, np.arange(POINTS_AT_A_TIME, points[-1], POINTS_AT_A_TIME))
    for part in np.split(np.arange(points.size), ends):
        if part.size:
            yield surface_points(body, planes, part)


def surface_points(
    body: Body, planes: tuple[Array, Array, Array], face: IndexArray
) -> SurfacePoints:
    """Points of the pieces into which planes across each axis cut some faces of the surface.

    Exact pieces: no piece lies on both sides of a plane. Planes (plane,) rise, m. A piece's three
    points integrate quadratic functions exactly (Hammer, Marlowe and Stroud, Math. Tables Aids
    Comput. 10 (1956) 130): its middle alone gave weak patterns a dipole that they do not have.
    """
    corners: Array = np.tile(np.eye(3), (face.size, 1, 1))
    for axis, across in enumerate(planes):
        face, corners = _cut(body.triangles[:, :, axis], face, corners, across)
    part = np.abs(np.linalg.det(corners)) / 3.0
    weights = (_THREE_POINTS @ corners).reshape(-1, 3)
    face, part = np.repeat(face, 3), np.repeat(part, 3)
    areas = body.area_vectors()
    size = np.linalg.norm(areas, axis=1)
    return SurfacePoints(
        position=np.einsum("pk,pki->pi", weights, body.triangles[face]),
        normal=areas[face] / np.maximum(size[face], np.finfo(float).tiny)[:, None],
        area=size[face] * part,
        face=face,
        weights=weights,
    )


def _cut(
    coordinate: Array, face: IndexArray, corners: Array, planes: Array
) -> tuple[IndexArray, Array]:
    """Cut pieces by all planes across one axis.

    Pieces are triangles: the face of each, and its corners as shares of that face's corners,
    (piece, corner, share). `coordinate` (face, corner) is that of the axis. A triangle with planes
    through it is cut by the middle one in three; that goes on until none is left.
    """
    tolerance = 1e-9 * np.diff(planes).min()
    faces, pieces = [], []
    while face.size:
        corner_coordinate = np.einsum("pck,pk->pc", corners, coordinate[face])
        first = np.searchsorted(planes, corner_coordinate.min(axis=1) + tolerance)
        last = np.searchsorted(planes, corner_coordinate.max(axis=1) - tolerance)
        crossed = last > first
        faces.append(face[~crossed])
        pieces.append(corners[~crossed])
        plane = planes[(first[crossed] + last[crossed]) // 2]
        corners = _in_three(corners[crossed], corner_coordinate[crossed] - plane[:, None])
        face = np.tile(face[crossed], 3)
    return np.concatenate(faces), np.concatenate(pieces)


def _in_three(corners: Array, depth: Array) -> Array:
    """Triangles cut by a plane at depth 0: the tip on one side, and two on the other."""
    above = depth > 0.0
    # The tip is the corner that is alone on its side of the plane.
    tip = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = np.arange(tip.size)[:, None]
    order = (tip[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(corners[row, order], 1, 0)
    depth_a, depth_b, depth_c = depth[row, order].T
    on_b = a + (b - a) * (depth_a / (depth_a - depth_b))[:, None]
    on_c = a + (c - a) * (depth_a / (depth_a - depth_c))[:, None]
    parts = [(a, on_b, on_c), (on_b, b, c), (on_b, c, on_c)]
    return np.concatenate([np.stack(part, axis=1) for part in parts])
