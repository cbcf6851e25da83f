"""Radiating bodies: closed triangle meshes, generated or read."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError
from ..base.regular_file import opened
from ..base.revolution import Profile
from .arrays import Array, IndexArray

_SECTIONS: Final = 128
"""Facets around an axis: the surface lies within 3e-4 of a radius of the true one."""
_SUBDIVISIONS: Final = 5
"""Subdivisions of an icosahedron: 20480 facets."""
LARGEST_FILE_BYTES: Final = 200 * 2**20


@dataclass(frozen=True)
class Body:
    """A closed surface of triangles whose normals point out of the body.

    It may have several parts; where parts that stand still overlap, the body is their union.
    """

    vertices: Array
    """(vertex, 3), m."""
    faces: IndexArray
    """Vertices of each triangle, counter-clockwise seen from outside, (face, 3)."""

    @property
    def triangles(self) -> Array:
        """Corners of the faces, (face, corner, 3), m."""
        return np.asarray(self.vertices[self.faces])

    def area_vectors(self) -> Array:
        """Area of each face times its unit normal, m², (face, 3)."""
        a, b, c = np.moveaxis(self.triangles, 1, 0)
        return np.asarray(0.5 * np.cross(b - a, c - a))

    @property
    def volume_m3(self) -> float:
        """Enclosed volume, negative where the normals point inwards."""
        return float(np.einsum("fi,fi->", self.triangles[:, 0], self.area_vectors()) / 3.0)

    @property
    def volume_per_area_m(self) -> float:
        """A third of the radius of a sphere, half the thickness of a plate, m."""
        return self.volume_m3 / float(np.linalg.norm(self.area_vectors(), axis=1).sum())

    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper corner of the bounding box, m."""
        return self.vertices.min(axis=0), self.vertices.max(axis=0)

    def flats(self, axis: int, least_area_m2: float) -> Array:
        """Coordinates of the plane faces across an axis, the largest first, m, (plane,)."""
        areas = self.area_vectors()
        size = np.linalg.norm(areas, axis=1)
        across = np.abs(areas[:, axis]) > (1.0 - 1e-9) * np.maximum(size, np.finfo(float).tiny)
        coordinate = np.round(self.triangles[across, 0, axis], 7)
        planes, which = np.unique(coordinate, return_inverse=True)
        total = np.bincount(which, size[across], planes.size)
        chosen = np.argsort(-total, kind="stable")
        return np.asarray(planes[chosen[total[chosen] >= least_area_m2]])

    def contains(self, point: Array) -> bool:
        """Whether a point (3,) lies inside: its solid angle seen by the surface is 4 pi.

        Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
        """
        a, b, c = np.moveaxis(self.triangles - point, 1, 0)
        la, lb, lc = (np.linalg.norm(corner, axis=1) for corner in (a, b, c))
        triple = np.einsum("fi,fi->f", a, np.cross(b, c))
        dots = [np.einsum("fi,fi->f", p, q) for p, q in ((a, b), (b, c), (c, a))]
        below = la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb
        return bool(np.sum(2.0 * np.arctan2(triple, below)) > 2.0 * np.pi)


def join_bodies(parts: list[Body]) -> Body:
    """Several bodies as one; the faces keep their order."""
    starts = np.cumsum([0, *(part.vertices.shape[0] for part in parts)])
    return Body(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)]),
    )


def sphere(radius_m: float, centre_m: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Body:
    """Sphere about a centre (x, y, z); its volume is exact."""
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=_SUBDIVISIONS, radius=radius_m)
    scale = (4.0 / 3.0 * np.pi * radius_m**3 / ball.volume) ** (1.0 / 3.0)
    return Body(scale * np.asarray(ball.vertices) + np.array(centre_m), np.asarray(ball.faces))


def turned(profile: Profile) -> Body:
    """Body of revolution about the z axis; sections across the axis have the exact area."""
    import trimesh

    angle = 2.0 * np.pi / _SECTIONS
    outline = profile.points() * [np.sqrt(angle / np.sin(angle)), 1.0]
    return _outward(trimesh.creation.revolve(outline, sections=_SECTIONS))


def block(lower: Array, upper: Array) -> Body:
    """Rectangular block between two corners."""
    import trimesh

    return _outward(trimesh.creation.box(bounds=[lower, upper]))


def _outward(mesh: Any) -> Body:
    """A mesh of trimesh with its normals out of the body."""
    if mesh.volume < 0.0:
        mesh.invert()
    return Body(np.asarray(mesh.vertices), np.asarray(mesh.faces))


def read_mesh(path: Path, unit_m: float) -> Body:
    """Body from an STL file whose lengths are in multiples of `unit_m`.

    Raises
    ------
    ParameterError
        The file cannot be read, or its surface is open or inverted.
    """
    import trimesh

    try:
        with opened(path, LARGEST_FILE_BYTES) as file:
            mesh = trimesh.load_mesh(file, file_type="stl")
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except Exception as error:  # whatever a broken file raises in the reader
        raise ParameterError(f"{path}: is no STL mesh: {error}") from None
    body = Body(unit_m * np.asarray(mesh.vertices), np.asarray(mesh.faces))
    return checked_mesh(body, str(path))


def checked_mesh(body: Body, name: str) -> Body:
    """The body, if its surface is closed and its normals point outwards.

    Raises
    ------
    ParameterError
        It has no faces, is open, is not oriented in one sense, or is inverted.
    """
    if body.faces.shape[0] == 0 or not np.all(np.isfinite(body.vertices)):
        raise ParameterError(f"{name}: the mesh has no triangles, or corners that are not finite")
    edges = body.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    forward = np.unique(edges, axis=0, return_counts=True)
    backward = np.unique(edges[:, ::-1], axis=0)
    if forward[0].shape != backward.shape or np.any(forward[0] != backward):
        missing = len(_rows(backward) - _rows(forward[0]))
        raise ParameterError(
            f"{name}: the mesh is not closed, or its triangles are not oriented in one sense: "
            f"{missing} edges lack a partner"
        )
    if np.any(forward[1] > 1):
        raise ParameterError(f"{name}: {np.sum(forward[1] > 1)} edges are shared by many triangles")
    if body.volume_m3 <= 0.0:
        raise ParameterError(
            f"{name}: the mesh is inverted: its normals point inwards "
            f"(volume {body.volume_m3:.3g} m³)"
        )
    return body


def _rows(pairs: IndexArray) -> set[tuple[int, ...]]:
    return {tuple(pair) for pair in pairs.tolist()}
