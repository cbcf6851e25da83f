"""Bodies of revolution: meridians from the bottom of the axis to its top, size and volume."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, pi
from typing import Any, ClassVar, Final, Protocol

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from .arrays import Array

Parameters = NDArray[np.floating[Any]]
"""Parameters along a curve, from 0 to 1, shape (point,)."""
Point = tuple[float, float]
"""Radius and height, m."""
_PIECES: Final = 32
"""Straight lines that a quarter of an ellipse is drawn with."""
_ON_AXIS: Final = 1e-12
"""Radii below this share of the largest one are rounding."""
_GAUSS_POINTS: Final = 16


class Curve(Protocol):
    """Smooth part of a meridian over a parameter from 0 to 1."""

    @property
    def pieces(self) -> int:
        """Straight lines that it is drawn with."""

    def __call__(self, t: Parameters) -> Array:
        """Return radius and height at parameters (point,), shape (point, 2), m."""

    def slope(self, t: Parameters) -> Array:
        """Return the derivative of radius and height by the parameter, shape (point, 2), m."""


@dataclass(frozen=True)
class Line:
    """Straight line between two points."""

    start: Point
    end: Point
    pieces: ClassVar[int] = 1

    def __call__(self, t: Parameters) -> Array:
        return np.asarray(np.array(self.start) + np.multiply.outer(t, self._step))

    def slope(self, t: Parameters) -> Array:
        return np.broadcast_to(self._step, (*np.shape(t), 2))

    @property
    def _step(self) -> Array:
        return np.subtract(self.end, self.start)


@dataclass(frozen=True)
class Arc:
    """Part of an ellipse about a point of the axis, between two angles from the horizontal."""

    middle_z_m: float
    radius_m: float
    height_m: float
    start_rad: float
    end_rad: float

    @property
    def pieces(self) -> int:
        return ceil(_PIECES * abs(self.end_rad - self.start_rad) / (pi / 2.0) - 1e-9)

    def __call__(self, t: Parameters) -> Array:
        angle = self.start_rad + (self.end_rad - self.start_rad) * t
        height = self.middle_z_m + self.height_m * np.sin(angle)
        return np.stack([self.radius_m * np.cos(angle), height], axis=-1)

    def slope(self, t: Parameters) -> Array:
        turn = self.end_rad - self.start_rad
        angle = self.start_rad + turn * t
        return turn * np.stack(
            [-self.radius_m * np.sin(angle), self.height_m * np.cos(angle)], axis=-1
        )


@dataclass(frozen=True)
class Profile:
    """Meridian of a body of revolution; the body is on its left, its axis is the z axis.

    Attributes
    ----------
    curves : end to end, from the bottom of the axis to its top
    """

    curves: tuple[Curve, ...]

    def points(self, longest_m: float | None = None) -> Array:
        """Return the meridian as straight lines, shape (point, 2), m.

        Parameters
        ----------
        longest_m : length of the lines; those that follow each curve closely where it is none
        """
        parts = [self.curves[0](np.zeros(1))]
        for curve in self.curves:
            number = curve.pieces
            if longest_m is not None:
                fine = curve(np.linspace(0.0, 1.0, number + 1))
                length_m = float(np.linalg.norm(np.diff(fine, axis=0), axis=1).sum())
                number = ceil(length_m / longest_m)
            parts.append(curve(np.linspace(0.0, 1.0, number + 1)[1:]))
        points = np.concatenate(parts)
        points[points[:, 0] < _ON_AXIS * points[:, 0].max(), 0] = 0.0
        return points

    @cached_property
    def radius_m(self) -> float:
        """Largest radius."""
        return float(self.points()[:, 0].max())

    @cached_property
    def bottom_z_m(self) -> float:
        """Height of the lowest point."""
        return float(self.points()[:, 1].min())

    @cached_property
    def top_z_m(self) -> float:
        """Height of the highest point."""
        return float(self.points()[:, 1].max())

    @property
    def height_m(self) -> float:
        """Distance from the lowest to the highest point."""
        return self.top_z_m - self.bottom_z_m

    @cached_property
    def volume_m3(self) -> float:
        """Volume of the body."""
        return self._volume_integral(0)

    @property
    def centroid_z_m(self) -> float:
        """Height of the centre of the body's volume."""
        return self._volume_integral(1) / self.volume_m3

    def _volume_integral(self, power: int) -> float:
        """Return the integral of a power of the height over the volume, m³ times m to the power.

        By Pappus' second theorem 2π times the first moment of the half section about the axis,
        which Green's theorem makes the line integral π ∮ r² z^power dz over the meridian.
        """
        local, weights = legendre.leggauss(_GAUSS_POINTS)
        t = 0.5 + 0.5 * local
        total = 0.0
        for curve in self.curves:
            radius, height = curve(t).T
            total += float(weights @ (radius**2 * height**power * curve.slope(t)[:, 1]))
        return 0.5 * pi * total

    def distance_m(self, radius_m: float, z_m: float) -> float:
        """Return the distance of a point from the body, m; zero in it."""
        points = self.points()
        start, step = points[:-1], np.diff(points, axis=0)
        ahead = np.array([radius_m, z_m]) - start
        share = np.clip(np.sum(ahead * step, axis=1) / np.sum(step**2, axis=1), 0.0, 1.0)
        beside = np.linalg.norm(ahead - share[:, None] * step, axis=1)
        passed = (points[:-1, 1] > z_m) != (points[1:, 1] > z_m)
        level = (z_m - start[passed, 1]) / step[passed, 1]
        outwards = start[passed, 0] + level * step[passed, 0] > radius_m
        return 0.0 if np.count_nonzero(outwards) % 2 else float(beside.min())


def capped_cylinder(
    radius_m: float, bottom_z_m: float, top_z_m: float, dome_height_m: float = 0.0
) -> Profile:
    """Return an upright cylinder with flat caps, or half-ellipsoids within its height."""
    low, high = bottom_z_m + dome_height_m, top_z_m - dome_height_m
    if dome_height_m <= 0.0:
        return polygon([(0.0, low), (radius_m, low), (radius_m, high), (0.0, high)])
    has_wall = high - low > 1e-9 * radius_m
    wall = [Line((radius_m, low), (radius_m, high))] if has_wall else []
    lower = Arc(low, radius_m, dome_height_m, -pi / 2.0, 0.0)
    return Profile((lower, *wall, Arc(high, radius_m, dome_height_m, 0.0, pi / 2.0)))


def sphere(radius_m: float, middle_z_m: float) -> Profile:
    """Return a sphere on the axis."""
    return Profile((Arc(middle_z_m, radius_m, radius_m, -pi / 2.0, pi / 2.0),))


def polygon(points: Sequence[Sequence[float]]) -> Profile:
    """Return straight lines between points (radius, height), m."""
    corners = [(float(radius), float(height)) for radius, height in points]
    return Profile(tuple(Line(a, b) for a, b in pairwise(corners)))


def shell_profile(shell: Mapping[str, Any]) -> Profile:
    """Return the outside of a machine's shell about its centre of mass.

    Parameters
    ----------
    shell : values in SI of the table `shell`, as parameters and results have them
    """
    bottom_z_m = -shell["centre_of_mass_height_m"]
    points = shell.get("profile_m")
    if points is not None:
        return polygon([(radius, bottom_z_m + height) for radius, height in points])
    return capped_cylinder(
        shell["outer_diameter_m"] / 2.0,
        bottom_z_m,
        bottom_z_m + shell["height_m"],
        shell["dome_height_m"],
    )
