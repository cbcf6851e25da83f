"""A body of revolution that radiates: patterns on its wall in, sound pressure anywhere out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, ComplexArray
from ..exact import wavenumber
from ..patterns import Pattern
from .around import at_angles, by_order
from .mesh import Mesh
from .null_field import null_points
from .solving import radiated, wall_pressure


@dataclass(frozen=True)
class WallPressure:
    """Pressure on the wall at one frequency."""

    frequency_hz: float
    orders: list[ComplexArray]
    """At the nodes per unit of each pattern, Pa, (node, column) of each order."""


class Radiator:
    """A mesh and the patterns on it, in free field or over a hard floor."""

    def __init__(
        self, mesh: Mesh, patterns: Sequence[Pattern], floor_z_m: float | None = None
    ) -> None:
        self.mesh = mesh
        self.floor_z_m = floor_z_m
        self.patterns = len(patterns)
        self.by_order = by_order(mesh, patterns)
        self._velocity = [column.velocity for column in self.by_order]
        self._null_points = null_points(mesh)

    @property
    def orders(self) -> int:
        """Number of orders around, from 0."""
        return len(self.by_order)

    @property
    def columns(self) -> int:
        """Number of velocities over all orders."""
        return sum(column.pattern.size for column in self.by_order)

    def solve(self, frequency_hz: float) -> WallPressure:
        """Pressure on the wall at a frequency."""
        k = float(wavenumber(np.array(frequency_hz)))
        pressure = wall_pressure(self.mesh, self._null_points, k, self._velocity, self.floor_z_m)
        return WallPressure(frequency_hz, pressure)

    def pressures(self, wall: WallPressure, points: Array) -> ComplexArray:
        """Sound pressure at points (point, 3) outside, Pa per unit, (point, pattern)."""
        k = float(wavenumber(np.array(wall.frequency_hz)))
        meridian = np.stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]], axis=1)
        # Points of a box, a map or a sphere share circles about the axis.
        circles, circle = np.unique(np.round(meridian, 10), axis=0, return_inverse=True)
        fields = radiated(self.mesh, circles, k, self._velocity, wall.orders, self.floor_z_m)
        angle = np.arctan2(points[:, 1], points[:, 0])
        around = [field[circle.ravel()] for field in fields]
        return at_angles(self.by_order, around, angle, self.patterns)
