"""Shapes of radiating bodies, as exact signed distances."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .arrays import Array


class Body(Protocol):
    """A closed body."""

    def signed_distance(self, points: Array) -> Array:
        """Distance of points (..., 3) to the surface, m; negative inside."""
        ...

    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper corner of the bounding box, m."""
        ...


@dataclass(frozen=True)
class Cylinder:
    """Upright cylinder with flat caps; its axis is the z axis."""

    radius_m: float
    bottom_z_m: float
    top_z_m: float

    def signed_distance(self, points: Array) -> Array:
        """Distance of points (..., 3) to the surface, m; negative inside."""
        radial = np.hypot(points[..., 0], points[..., 1]) - self.radius_m
        middle, half = (self.bottom_z_m + self.top_z_m) / 2, (self.top_z_m - self.bottom_z_m) / 2
        axial = np.abs(points[..., 2] - middle) - half
        outside = np.hypot(np.maximum(radial, 0.0), np.maximum(axial, 0.0))
        distance: Array = outside + np.minimum(np.maximum(radial, axial), 0.0)
        return distance

    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper corner of the bounding box, m."""
        radius = self.radius_m
        return (
            np.array([-radius, -radius, self.bottom_z_m]),
            np.array([radius, radius, self.top_z_m]),
        )


@dataclass(frozen=True)
class Sphere:
    """Sphere about a centre (x, y, z)."""

    radius_m: float
    centre_m: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def signed_distance(self, points: Array) -> Array:
        """Distance of points (..., 3) to the surface, m; negative inside."""
        distance: Array = np.linalg.norm(points - np.array(self.centre_m), axis=-1) - self.radius_m
        return distance

    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper corner of the bounding box, m."""
        centre = np.array(self.centre_m)
        return centre - self.radius_m, centre + self.radius_m


def outward_normal(body: Body, points: Array) -> Array:
    """Unit normals out of the body at points (..., 3): the gradient of the signed distance."""
    step = 1e-6
    gradient = np.stack(
        [
            body.signed_distance(points + step * axis) - body.signed_distance(points - step * axis)
            for axis in np.eye(3)
        ],
        axis=-1,
    )
    normal: Array = gradient / np.linalg.norm(gradient, axis=-1, keepdims=True)
    return normal
