"""Biquadratic elements for sound in a space of revolution: its meridian, its wall's force."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array, IndexArray

DISC: Final = (14, 8)
"""Elements across and along the axis; modes of a flat disc below 4.5 kHz are right to 3e-4."""
ANNULUS: Final = (6, 14)
"""Elements of an annulus, which is narrow and high."""


@dataclass(frozen=True)
class Profile:
    """Space between a lower and an upper face, from the axis or an inner edge to the outer one.

    Attributes
    ----------
    radius : radius of the nodes' columns, ends and middles of elements in turn, rising, shape
        (2 columns + 1,), m
    lower, upper : heights of the faces there, shape (2 columns + 1,), m
    rows : elements between them
    """

    radius: Array
    lower: Array
    upper: Array
    rows: int

    @property
    def nodes(self) -> Array:
        """Radius and height, column by column from below, shape (column, row, 2)."""
        share = np.linspace(0.0, 1.0, 2 * self.rows + 1)
        height = self.lower[:, None] + share * (self.upper - self.lower)[:, None]
        radius = np.broadcast_to(self.radius[:, None], height.shape)
        return np.stack([radius, height], axis=2)

    @property
    def elements(self) -> IndexArray:
        """Nodes of each element, three columns of three, shape (element, 9)."""
        numbers = np.arange(self.radius.size * (2 * self.rows + 1)).reshape(self.radius.size, -1)
        windows = np.lib.stride_tricks.sliding_window_view(numbers, (3, 3))[::2, ::2]
        return np.asarray(windows.reshape(-1, 9))


def disc_profile(radius_m: float, cap_height_m: float, depth_m: float, floor_z_m: float) -> Profile:
    """A disc on a flat floor, under a cap that is half an ellipsoid, or flat.

    Parameters
    ----------
    radius_m : radius of the wall
    cap_height_m : height of the cap over its rim; 0 is flat
    depth_m : depth of the floor under the rim
    floor_z_m : height of the floor
    """
    angle = np.linspace(0.0, 0.5 * np.pi, 2 * DISC[0] + 1)
    share = np.sin(angle) if cap_height_m > 0.0 else np.linspace(0.0, 1.0, angle.size)
    rise = cap_height_m * np.cos(angle)
    floor = np.full(angle.size, floor_z_m)
    return Profile(np.asarray(radius_m * share), floor, floor + depth_m + rise, DISC[1])


def annulus_profile(inner_m: float, outer_m: float, lower_m: float, upper_m: float) -> Profile:
    """A space between two cylinders and two flat faces."""
    radius = np.linspace(inner_m, outer_m, 2 * ANNULUS[0] + 1)
    lower, upper = np.full(radius.size, lower_m), np.full(radius.size, upper_m)
    return Profile(np.asarray(radius), lower, upper, ANNULUS[1])


_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)


def quadratic(x: Array) -> Array:
    """Shapes along one direction of an element that are 1 at -1, at 0 and at 1, (point, 3)."""
    return np.stack([0.5 * x * (x - 1.0), 1.0 - x**2, 0.5 * x * (x + 1.0)], axis=-1)


def quadratic_slope(x: Array) -> Array:
    """Their derivatives, shape (point, 3)."""
    return np.stack([x - 0.5, -2.0 * x, x + 0.5], axis=-1)


def squared_around(order: int) -> float:
    """∫ cos² nθ dθ."""
    return 2.0 * np.pi if order == 0 else np.pi


def matrices(profile: Profile, order: int) -> tuple[Array, Array]:
    """Stiffness and mass of all nodes, both (node, node), m and m³.

    Parameters
    ----------
    profile : the space
    order : waves around the axis
    """
    flat, slope = quadratic(_POINTS), quadratic_slope(_POINTS)
    weight = np.multiply.outer(_WEIGHTS, _WEIGHTS).ravel()
    shapes, across, along = (np.kron(a, b) for a, b in ((flat, flat), (slope, flat), (flat, slope)))
    elements = profile.elements
    points = profile.nodes.reshape(-1, 2)[elements]
    radius = points[..., 0] @ shapes.T
    jacobian = np.stack(
        [np.swapaxes(points, 1, 2) @ derivative.T for derivative in (across, along)], axis=1
    )
    jacobian = np.moveaxis(jacobian, 3, 1)
    volume = squared_around(order) * weight * radius * np.linalg.det(jacobian)
    local = np.stack([across, along], axis=1)
    gradient = np.linalg.solve(jacobian, np.broadcast_to(local, (len(elements), *local.shape)))
    stiffness = np.einsum("eg,egda,egdb->eab", volume, gradient, gradient, optimize=True)
    stiffness += order**2 * np.einsum("eg,ga,gb->eab", volume / radius**2, shapes, shapes)
    mass = np.einsum("eg,ga,gb->eab", volume, shapes, shapes)
    count = profile.radius.size * (2 * profile.rows + 1)
    total = np.zeros((2, count, count))
    indices = (elements[:, :, None], elements[:, None, :])
    np.add.at(total[0], indices, stiffness)
    np.add.at(total[1], indices, mass)
    return total[0], total[1]


def interpolation(profile: Profile, radius_m: float, height_m: float) -> Array:
    """Return the weight of each node at a point of the space, shape (node,); points beyond are on
    its edge."""
    ends = profile.radius[::2]
    column = int(np.clip(np.searchsorted(ends, radius_m) - 1, 0, ends.size - 2))
    across = _within(profile.radius[2 * column : 2 * column + 3], radius_m)
    weights = np.zeros(profile.radius.size)
    weights[2 * column : 2 * column + 3] = quadratic(np.asarray(across))
    low, high = weights @ profile.lower, weights @ profile.upper
    share = float(np.clip((height_m - low) / (high - low), 0.0, 1.0)) * profile.rows
    row = min(int(share), profile.rows - 1)
    upwards = np.zeros(2 * profile.rows + 1)
    upwards[2 * row : 2 * row + 3] = quadratic(np.asarray(2.0 * (share - row) - 1.0))
    return np.asarray(np.outer(weights, upwards).ravel())


def _within(radii: Array, radius_m: float) -> float:
    """Coordinate from -1 to 1 at which the three radii of an element give a radius."""
    middle, half = radii[1], 0.5 * (radii[2] - radii[0])
    bend = 0.5 * (radii[2] + radii[0]) - middle
    coordinate = 0.0
    for _ in range(20):
        coordinate -= (middle + half * coordinate + bend * coordinate**2 - radius_m) / (
            half + 2.0 * bend * coordinate
        )
    return float(np.clip(coordinate, -1.0, 1.0))
