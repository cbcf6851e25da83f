"""Meridian of a space of revolution, laid out for quadratic elements."""

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
