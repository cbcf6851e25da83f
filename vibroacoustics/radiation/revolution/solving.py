"""Pressure on the wall of a body of revolution, one order after the other, by least squares."""

from collections.abc import Sequence

import numpy as np
from scipy import linalg

from ...base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, ComplexArray
from .layers import layers
from .mesh import Mesh


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
    mesh : of the meridian
    null : points in the body where the field vanishes, (point, 2), m
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
    pressure: ComplexArray = scaled / row[:nodes, None]
    return pressure


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
