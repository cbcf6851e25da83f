"""A body of revolution that radiates: patterns on its wall in, sound pressure anywhere out."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import linalg
from scipy.stats import qmc

from ...base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, ComplexArray, IndexArray
from ..exact import wavenumber
from ..patterns import Pattern
from ..surface_points import SurfacePoints
from .layers import layers
from .mesh import Mesh

_NODES_PER_POINT: Final = 5
_LEAST: Final = 16
_CLEARANCE: Final = 0.04
"""Least distance from the wall over the body's radius."""
HIGHEST_ORDER: Final = 48
_ANGLES: Final = 128
_NO_SHARE: Final = 1e-7
"""Orders up to this share of a pattern's largest velocity come from rounding."""


@dataclass(frozen=True)
class OrderColumns:
    """Columns of one order that some patterns have."""

    pattern: IndexArray
    """Pattern of each column, (column,)."""
    sine: IndexArray
    """0 where the column is the cosine's, 1 where it is the sine's, (column,)."""
    velocity: Array
    """Normal velocity at the nodes, (node, column), per unit of the pattern."""


@dataclass(frozen=True)
class WallPressure:
    """Pressure on the wall at one frequency."""

    frequency_hz: float
    orders: list[ComplexArray]
    """Orders at the nodes per unit of each pattern, Pa, (node, column) of each order."""


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


def wall_pressure(
    mesh: Mesh,
    null: Array,
    wavenumber: float,
    velocity: Sequence[Array],
    floor_z_m: float | None = None,
) -> list[ComplexArray]:
    """Pressure at the nodes, Pa, (node, column) of each order.

    p/2 = D p + j omega rho S v on the wall and 0 = D p + j omega rho S v inside, v out of the body.

    Parameters
    ----------
    mesh : mesh of the meridian
    null : points in the body where the field vanishes, shape (point, 2), m
    wavenumber : rad/m
    velocity : normal velocity at the nodes, (node, column) of each order, m/s
    floor_z_m : height of a hard floor
    """
    nodes = len(mesh.points)
    points = np.concatenate([mesh.points, null])
    single, double = layers(mesh, points, wavenumber, len(velocity), floor_z_m)
    area = mesh.weights * mesh.points[:, 0]
    row = np.concatenate([np.sqrt(area), np.full(len(null), np.sqrt(area.sum() / len(null)))])
    return [
        _solved(row, nodes, s, d, v, wavenumber)
        for s, d, v in zip(single, double, velocity, strict=True)
    ]


def _solved(
    row: Array, nodes: int, single: ComplexArray, double: ComplexArray, v: Array, k: float
) -> ComplexArray:
    """Pressure (node, column) of one order; rows and unknowns count by their area."""
    if v.shape[1] == 0:
        return np.zeros(v.shape, dtype=complex)
    matrix = -double
    matrix[np.arange(nodes), np.arange(nodes)] += 0.5
    impedance = 1j * k * SPEED_OF_SOUND_M_PER_S * AIR_DENSITY_KG_PER_M3
    right = impedance * (single @ v)
    q, r = linalg.qr(
        row[:, None] * matrix / row[:nodes], mode="economic", check_finite=False, overwrite_a=True
    )
    scaled = linalg.solve_triangular(r, q.conj().T @ (row[:, None] * right), check_finite=False)
    return np.asarray(scaled / row[:nodes, None])


def radiated(
    mesh: Mesh,
    points: Array,
    wavenumber: float,
    velocity: Sequence[Array],
    pressure: Sequence[ComplexArray],
    floor_z_m: float | None = None,
) -> list[ComplexArray]:
    """Pressure of each order at points (point, 2) outside, Pa, (point, column)."""
    single, double = layers(mesh, points, wavenumber, len(velocity), floor_z_m)
    impedance = 1j * wavenumber * SPEED_OF_SOUND_M_PER_S * AIR_DENSITY_KG_PER_M3
    return [
        d @ p + impedance * (s @ v)
        for s, d, v, p in zip(single, double, velocity, pressure, strict=True)
    ]


def null_points(mesh: Mesh) -> Array:
    """Points (point, 2) in the body: radius and height, m; even in volume."""
    wanted = max(_LEAST, len(mesh.points) // _NODES_PER_POINT)
    lower, upper = mesh.points.min(axis=0), mesh.points.max(axis=0)
    share = qmc.Halton(2, scramble=False).random(40 * wanted)[1:]
    points = np.stack(
        [upper[0] * np.sqrt(share[:, 0]), lower[1] + (upper[1] - lower[1]) * share[:, 1]], axis=1
    )
    return np.asarray(points[mesh.depth_m(points) > _CLEARANCE * upper[0]][:wanted])


def by_order(mesh: Mesh, patterns: Sequence[Pattern]) -> list[OrderColumns]:
    """Normal velocities of the patterns by order, 0 to the highest that any of them has."""
    normal = np.array([_normal_velocity(mesh, pattern) for pattern in patterns])
    spectrum = np.fft.rfft(normal, axis=2)[:, :, : HIGHEST_ORDER + 1] * (2.0 / _ANGLES)
    spectrum[:, :, 0] /= 2.0
    parts = np.stack([spectrum.real, -spectrum.imag])  # (sine, pattern, node, order)
    size = np.abs(parts).max(axis=2)
    has = size > _NO_SHARE * np.maximum(np.abs(normal).max(axis=(1, 2)), 1e-300)[None, :, None]
    has &= size > 1e-14 * float(np.abs(normal).max(initial=0.0))
    orders = np.flatnonzero(has.any(axis=(0, 1)))
    columns = []
    for order in range(int(orders[-1]) + 1 if orders.size else 1):
        sine, pattern = np.nonzero(has[:, :, order])
        columns.append(OrderColumns(pattern, sine, parts[sine, pattern, :, order].T))
    return columns


def _normal_velocity(mesh: Mesh, pattern: Pattern) -> Array:
    """Normal velocity (node, angle)."""
    angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    position, normal = _turned(mesh.points, angle), _turned(mesh.normals, angle)
    number = len(position)
    area = np.repeat(mesh.weights * mesh.points[:, 0], _ANGLES) * (2.0 * np.pi / _ANGLES)
    points = SurfacePoints(
        position, normal, area, np.zeros(number, dtype=np.intp), np.full((number, 3), 1.0 / 3.0)
    )
    velocity = np.asarray(pattern.velocity(points), dtype=float)
    return np.asarray(np.einsum("pi,pi->p", velocity, normal).reshape(-1, _ANGLES))


def _turned(meridian: Array, angle: Array) -> Array:
    """Vectors of the meridian (node, 2) at angles around the axis, (node and angle, 3)."""
    radial, axial = meridian[:, :1], np.broadcast_to(meridian[:, 1:], (len(meridian), angle.size))
    turned = np.stack([radial * np.cos(angle), radial * np.sin(angle), axial], axis=-1)
    return turned.reshape(-1, 3)


def at_angles(
    columns: Sequence[OrderColumns],
    fields: Sequence[ComplexArray],
    angle: Array,
    patterns: int,
) -> ComplexArray:
    """Sum of the orders' fields (point, column) at the points' angles: (point, pattern)."""
    total = np.zeros((angle.size, patterns), dtype=complex)
    for order, (column, field) in enumerate(zip(columns, fields, strict=True)):
        turns = np.stack([np.cos(order * angle), np.sin(order * angle)])[column.sine].T
        # A pattern has a cosine and a sine column at most.
        for sine in (0, 1):
            chosen = column.sine == sine
            total[:, column.pattern[chosen]] += (field * turns)[:, chosen]
    return total
