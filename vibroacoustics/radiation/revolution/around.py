"""Velocities of the wall around the axis as Fourier orders: cosine and sine columns."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Array, ComplexArray, IndexArray
from ..patterns import Pattern
from ..surface_points import SurfacePoints
from .mesh import Mesh

HIGHEST_ORDER: Final = 48
_ANGLES: Final = 128
_NO_SHARE: Final = 1e-7
"""Orders up to this share of a pattern's largest velocity come from rounding."""


@dataclass(frozen=True)
class OrderColumns:
    """Columns of one order that some patterns have."""

    pattern: IndexArray
    """Which pattern each column belongs to, (column,)."""
    sine: IndexArray
    """0 where the column is the cosine's, 1 where it is the sine's, (column,)."""
    velocity: Array
    """Normal velocity at the nodes, (node, column), per unit of the pattern."""


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
    at = SurfacePoints(
        position, normal, area, np.zeros(number, dtype=np.intp), np.full((number, 3), 1.0 / 3.0)
    )
    velocity = np.asarray(pattern.velocity(at), dtype=float)
    along: Array = np.einsum("pi,pi->p", velocity, normal).reshape(-1, _ANGLES)
    return along


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
