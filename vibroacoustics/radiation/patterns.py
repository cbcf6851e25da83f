"""Surface velocities: how each point of the body's wall moves."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..base.errors import ParameterError
from ..base.vocabulary import RIGID_BODY_DOFS
from .arrays import Array
from .bodies import Body
from .surface_points import SurfacePoints


@dataclass(frozen=True)
class Pattern:
    """One way in which the whole wall moves, per unit of its generalised velocity."""

    name: str
    velocity: Callable[[SurfacePoints], Array]
    """Velocity vectors (point, 3) at points of the surface."""


class SurfaceMotion(Protocol):
    """A motion of the surface that comes from elsewhere, such as an elastic mode."""

    @property
    def name(self) -> str:
        """Unique among the patterns."""

    def velocity(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Velocity vectors (point, 3) per unit of the motion, at points (point, 3)."""


def rigid_body_velocity(dof: str, points: Array) -> Array:
    """Velocity of points (..., 3) of a rigid body per unit of one degree of freedom.

    v = e for a translation and v = e x r for a rotation about the origin, the centre of mass.

    Raises
    ------
    ParameterError
        The degree of freedom is not one of `RIGID_BODY_DOFS`.
    """
    if dof not in RIGID_BODY_DOFS:
        raise ParameterError(f"dof: {dof!r} is not one of {', '.join(RIGID_BODY_DOFS)}")
    axis = np.eye(3)["xyz".index(dof[1])]
    velocity: Array = (
        np.broadcast_to(axis, points.shape) if dof[0] == "t" else np.cross(axis, points)
    )
    return velocity


def rigid_body(dof: str) -> Pattern:
    """Pattern of unit velocity of one rigid-body degree of freedom."""
    return Pattern(dof, lambda points: rigid_body_velocity(dof, points.position))


def surface_motion(motion: SurfaceMotion) -> Pattern:
    """Pattern of a motion that comes from elsewhere."""
    return Pattern(
        motion.name, lambda points: motion.velocity(np.asarray(points.position, dtype=float))
    )


def sampled(name: str, body: Body, values: Array) -> Pattern:
    """Pattern given on a body's mesh: one value for each face, or one for each vertex.

    Values (face,) or (vertex,) are normal velocities, (face, 3) or (vertex, 3) vectors; those of
    the vertices vary linearly over each face. Where faces and vertices are equally many, the values
    belong to the faces.

    Raises
    ------
    ParameterError
        The values are of another number or shape, or not finite.
    """
    values = np.asarray(values, dtype=float)
    numbers = {body.faces.shape[0]: "face", body.vertices.shape[0]: "vertex"}
    vectors = values.ndim == 2 and values.shape[1] == 3
    if not (values.ndim == 1 or vectors) or values.shape[0] not in numbers:
        raise ParameterError(
            f"pattern {name}: shape {values.shape}: the mesh has {body.faces.shape[0]} faces and "
            f"{body.vertices.shape[0]} vertices; one value or vector is needed for each of either"
        )
    if not np.all(np.isfinite(values)):
        raise ParameterError(f"pattern {name}: holds values that are not finite")
    by_face = values.shape[0] == body.faces.shape[0]

    def velocity(points: SurfacePoints) -> Array:
        if by_face:
            local = values[points.face]
        else:
            local = np.einsum("pk,pk...->p...", points.weights, values[body.faces[points.face]])
        return local if vectors else local[:, None] * points.normal

    return Pattern(name, velocity)
