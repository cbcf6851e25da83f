"""Change of the sound of a body of revolution on a hard floor by ground and barrier.

The wall's pressure is that over the hard floor. Over it and its velocity the difference of both
Green's functions is integrated; that has no singularity above the ground, as its sources are images
below. For a source in the body that moves no wall this is exact (Green's second identity).
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from ...base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, ComplexArray
from ..exact import green, wavenumber
from ..scene import Scene
from .mesh import Mesh
from .radiator import Radiator, WallPressure

_STEP_M: Final = 1e-3
"""Step to both sides of the wall for the normal derivative."""
_MORE_ANGLES: Final = 48
"""More angles than twice the orders."""

AtFrequency = Callable[[Radiator, WallPressure], ComplexArray]
"""Function of values on the wall at a frequency to the addition to pressures, (point, pattern)."""


def over_ground(scene: Scene, points: Array) -> AtFrequency | None:
    """Return the addition to the pressure over the hard floor at points (point, 3); none on a
    floor."""
    outdoors = scene.outdoors
    if outdoors is None:
        return None

    def added(radiator: Radiator, wall: WallPressure) -> ComplexArray:
        mesh, hertz = radiator.mesh, wall.frequency_hz
        angle = 2.0 * np.pi * np.arange(2 * radiator.orders + _MORE_ANGLES)
        angle /= angle.size
        inner, outer = (_turned(mesh, side * _STEP_M, angle) for side in (-1.0, 1.0))
        area = mesh.weights * mesh.points[:, 0] * (2.0 * np.pi / angle.size)
        result = np.zeros((len(points), radiator.patterns), dtype=complex)
        for row, point in enumerate(points):
            low, high = (
                outdoors.green(near, point, hertz, scene.upright_walls)
                - green(near, point, np.array([hertz]), scene.walls)[0]
                for near in (inner, outer)
            )
            value = area[:, None] * (0.5 * (high + low)).reshape(-1, angle.size)
            slope = area[:, None] * ((high - low) / (2.0 * _STEP_M)).reshape(-1, angle.size)
            result[row] = _joined(radiator, wall, angle, value, slope)
        return result

    return added


def _joined(
    radiator: Radiator, wall: WallPressure, angle: Array, value: ComplexArray, slope: ComplexArray
) -> ComplexArray:
    """Integral of p ∂G/∂n - G ∂p/∂n by order around, (pattern,); ∂p/∂n = -j ω ρ v."""
    k = float(wavenumber(np.array(wall.frequency_hz)))
    impedance = 1j * k * SPEED_OF_SOUND_M_PER_S * AIR_DENSITY_KG_PER_M3
    total = np.zeros(radiator.patterns, dtype=complex)
    for order, (column, pressure) in enumerate(zip(radiator.by_order, wall.orders, strict=True)):
        turns = np.stack([np.cos(order * angle), np.sin(order * angle)], axis=1)
        of_value, of_slope = (value @ turns)[:, column.sine], (slope @ turns)[:, column.sine]
        each = (pressure * of_slope + impedance * column.velocity * of_value).sum(axis=0)
        np.add.at(total, column.pattern, each)
    return total


def _turned(mesh: Mesh, offset_m: float, angle: Array) -> Array:
    """Nodes that far off the wall, turned about the axis, (node and angle, 3)."""
    radius, height = (mesh.points + offset_m * mesh.normals).T
    x, y = radius[:, None] * np.cos(angle), radius[:, None] * np.sin(angle)
    z = np.broadcast_to(height[:, None], x.shape)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3)
