"""Plane walls as mirrors: the image sources that stand for them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Array


@dataclass(frozen=True)
class Mirror:
    """An infinite wall across one axis; no two of a room are parallel.

    With a reflection factor below 1 the image is weaker by it, in every direction: the wall of a
    half space of heavier fluid with the same speed of sound. Walls that absorb by their local
    impedance reflect less at some angles than at others; a mirror is their mean.
    """

    axis: int
    sign: int
    """-1: the wall bounds the room below, 1: above."""
    position_m: float
    reflection: float = 1.0
    """Share of the pressure that comes back, 0 to 1."""

    @property
    def hard(self) -> bool:
        return self.reflection == 1.0

    def depth_m(self, points: Array) -> Array:
        """Distance of points (..., 3) from the wall, into the room, m."""
        depth: Array = self.sign * (self.position_m - points[..., self.axis])
        return depth


def images(source: Array, mirrors: Sequence[Mirror]) -> tuple[Array, Array]:
    """A source (3,) and all of its images: positions (image, 3), m, and strengths (image,)."""
    positions: Array = np.asarray(source, dtype=float)[None, :]
    strengths: Array = np.ones(1)
    for mirror in mirrors:
        reflected = positions.copy()
        reflected[:, mirror.axis] = 2.0 * mirror.position_m - reflected[:, mirror.axis]
        positions = np.concatenate([positions, reflected])
        strengths = np.concatenate([strengths, mirror.reflection * strengths])
    return positions, strengths
