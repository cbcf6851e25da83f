"""Surface velocities: how each point of the body's wall moves."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..errors import ParameterError
from ..schema import RIGID_BODY_DOFS
from .arrays import Array
from .bodies import Body, outward_normal


@dataclass(frozen=True)
class Pattern:
    """One way in which the whole wall moves, per unit of its generalised velocity."""

    name: str
    velocity: Callable[[Array], Array]
    """Points (..., 3), m -> velocity vectors (..., 3)."""
    volume_velocity_m3_per_s: float = 0.0
    """Exact net volume velocity through the closed surface; zero for a rigid body."""


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
    return Pattern(dof, lambda points: rigid_body_velocity(dof, points))


def pulsating(body: Body, surface_area_m2: float) -> Pattern:
    """Unit normal velocity (m/s) all over the body, whose exact surface area is given."""
    return Pattern("pulsating", lambda points: outward_normal(body, points), surface_area_m2)
