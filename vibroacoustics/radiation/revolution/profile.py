"""Meridians of bodies of revolution: smooth curves from the bottom of the axis to its top."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from ...machine.shell import Shell
from ...study.body import RadiatingBody, ShellBody, SphereBody
from ..arrays import Array

Curve = Callable[[Array], Array]
"""From parameters 0 to 1 (point,) to radius and height (point, 2), m; smooth."""
_CORNER_RAD: Final = 0.05
"""Two curves that meet at more than this angle meet at an edge."""
_ON_AXIS_M: Final = 1e-9


@dataclass(frozen=True)
class Profile:
    """Curves end to end; the body is on their left, its axis is the z axis."""

    curves: tuple[Curve, ...]

    def edges(self) -> list[tuple[bool, bool]]:
        """Whether each curve begins and ends at an edge; tips on the axis are edges, too."""
        tangents = [_end_tangents(curve) for curve in self.curves]
        outward, inward = np.array([1.0, 0.0]), np.array([-1.0, 0.0])
        before = [_start_of(self.curves[0], outward), *(end for _, end in tangents[:-1])]
        after = [*(start for start, _ in tangents[1:]), inward]
        return [
            (_turns(previous, start), _turns(end, following))
            for (start, end), previous, following in zip(tangents, before, after, strict=True)
        ]


def _start_of(curve: Curve, outward: Array) -> Array:
    """Direction in which the meridian comes to its start: on the axis, or mirrored in a floor."""
    start, _ = _end_tangents(curve)
    if curve(np.zeros(1))[0, 0] <= _ON_AXIS_M:
        return outward
    return np.asarray(start * np.array([-1.0, 1.0]))


def _end_tangents(curve: Curve) -> tuple[Array, Array]:
    step = 1e-6
    points = curve(np.array([0.0, step, 1.0 - step, 1.0]))
    steps = np.array([points[1] - points[0], points[3] - points[2]])
    start, end = steps / np.linalg.norm(steps, axis=1)[:, None]
    return start, end


def _turns(first: Array, second: Array) -> bool:
    return bool(np.arccos(np.clip(first @ second, -1.0, 1.0)) > _CORNER_RAD)


def line(start: Sequence[float], end: Sequence[float]) -> Curve:
    """Straight line between two points (radius, height), m."""
    first, last = np.array(start, dtype=float), np.array(end, dtype=float)
    return lambda t: first + np.multiply.outer(t, last - first)


def arc(
    middle_z_m: float, radius_m: float, height_m: float, start_rad: float, end_rad: float
) -> Curve:
    """Part of an ellipse about a point of the axis, between two angles from the horizontal."""

    def curve(t: Array) -> Array:
        angle = start_rad + (end_rad - start_rad) * t
        points: Array = np.stack(
            [radius_m * np.cos(angle), middle_z_m + height_m * np.sin(angle)], axis=-1
        )
        return points

    return curve


def capped_cylinder(
    radius_m: float, bottom_z_m: float, top_z_m: float, dome_height_m: float = 0.0
) -> Profile:
    """Upright cylinder with flat caps or half-ellipsoids of a height, which is part of its own."""
    low, high = bottom_z_m + dome_height_m, top_z_m - dome_height_m
    side = [line((radius_m, low), (radius_m, high))] if high - low > 1e-9 * radius_m else []
    if dome_height_m > 0.0:
        quarter = np.pi / 2.0
        return Profile(
            (
                arc(low, radius_m, dome_height_m, -quarter, 0.0),
                *side,
                arc(high, radius_m, dome_height_m, 0.0, quarter),
            )
        )
    return polygon([(0.0, low), (radius_m, low), (radius_m, high), (0.0, high)])


def sphere(radius_m: float, middle_z_m: float) -> Profile:
    """Sphere on the axis."""
    return Profile((arc(middle_z_m, radius_m, radius_m, -np.pi / 2.0, np.pi / 2.0),))


def polygon(points: Sequence[Sequence[float]]) -> Profile:
    """Straight lines between points (radius, height), m: cylinders, cones, steps."""
    return Profile(tuple(line(a, b) for a, b in pairwise(points)))


def above_floor(profile: Profile, floor_z_m: float | None) -> Profile:
    """The profile without curves that lie on the floor: what stands on it radiates nothing."""
    if floor_z_m is None:
        return profile
    samples = np.linspace(0.0, 1.0, 5)
    kept = [c for c in profile.curves if np.ptp([floor_z_m, *c(samples)[:, 1]]) > 1e-9]
    return Profile(tuple(kept))


def shell_profile(shell: Shell, body: RadiatingBody) -> Profile | None:
    """Meridian of a study's body about the machine's centre of mass; none if it has none."""
    bottom = -shell.centre_of_mass_height_m
    if isinstance(body, SphereBody):
        return sphere(body.diameter_m / 2.0, bottom + body.diameter_m / 2.0)
    if isinstance(body, ShellBody):
        return capped_cylinder(shell.radius_m, bottom, bottom + shell.height_m, shell.dome_height_m)
    return None
