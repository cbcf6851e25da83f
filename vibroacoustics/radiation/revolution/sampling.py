"""Few frequencies solved, the others interpolated with an estimated error; ground and barrier."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import make_interp_spline

from ...base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, ComplexArray, IndexArray
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


TOLERANCE: Final = 1e-3
"""Largest estimated error of interpolation over each pattern's largest pressure: 0.01 dB."""
_FIRST_HZ: Final = 200.0
"""Distance of the frequencies solved first."""
_GAIN: Final = 16.0
"""Error at an omitted solved frequency over that beside it, about; 2⁶ for fine steps."""
_DEGREE: Final = 5

Solve = Callable[[IndexArray], tuple[ComplexArray, Array]]
"""Function of indices of frequencies to pressures and their errors, (index, receiver, pattern)."""


@dataclass(frozen=True)
class Sampled:
    """Pressures at all tabulated frequencies, (frequency, receiver, pattern)."""

    pressure: ComplexArray
    error: Array
    """Estimated error: of the meshes, and of the interpolation where it is no solved frequency."""
    solved: IndexArray
    """Indices of the solved frequencies."""

    def selected(self, frequencies: slice, receivers: Sequence[int]) -> "Sampled":
        """Return the pressures at the first frequencies and at some receivers."""
        pressure, error = self.pressure[frequencies, receivers], self.error[frequencies, receivers]
        return Sampled(pressure, error, self.solved[self.solved < len(pressure)])


def sample(table_hz: Array, delay_s: Array, solve: Solve) -> Sampled:
    """Solve as few of evenly spaced frequencies as `TOLERANCE` allows; `delay_s` (receiver,)."""
    solved = first_solved(table_hz)
    pressure, error = solve(solved)
    while True:
        smooth, beside = _smooth_and_error(table_hz[solved], delay_s, pressure)
        # Nor do more frequencies help where the meshes' error is larger.
        allowed = TOLERANCE * np.abs(pressure).max(axis=1) + error.max(axis=1)
        wrong = np.any(beside.max(axis=1) > allowed, axis=1)
        more = _between(solved, np.flatnonzero(wrong))
        if more.size == 0:
            return _everywhere(table_hz, delay_s, solved, smooth, error, beside)
        new_pressure, new_error = solve(more)
        order = np.argsort(np.concatenate([solved, more]))
        solved = np.concatenate([solved, more])[order]
        pressure = np.concatenate([pressure, new_pressure])[order]
        error = np.concatenate([error, new_error])[order]


def first_solved(table_hz: Array) -> IndexArray:
    """Even steps, half and a quarter of the first one, and both ends."""
    last = table_hz.size - 1
    step = max(1, round(_FIRST_HZ / table_hz[0]))
    below = [step // 4 - 1, step // 2 - 1]
    steps = [0, *(i for i in below if i > 0), *range(step - 1, last, step), last]
    return np.unique(np.array(steps, dtype=np.intp))


def interpolated(
    table_hz: Array, delay_s: Array, solved: IndexArray, pressure: ComplexArray
) -> Sampled:
    """Pressures at all frequencies from exact ones at solved frequencies.

    Parameters
    ----------
    table_hz : shape (frequency,)
    delay_s : shape (receiver,)
    solved : indices of the solved frequencies, shape (solved,)
    pressure : there, shape (solved, receiver, pattern), Pa
    """
    smooth, beside = _smooth_and_error(table_hz[solved], delay_s, pressure)
    return _everywhere(table_hz, delay_s, solved, smooth, np.zeros(pressure.shape), beside)


def _smooth_and_error(
    solved_hz: Array, delay_s: Array, pressure: ComplexArray
) -> tuple[ComplexArray, Array]:
    """Pressures without their trend, and the estimated error of interpolation beside each, Pa."""
    trend = _trend(solved_hz, delay_s)
    smooth = pressure / trend
    return smooth, _left_out(solved_hz, smooth) / _GAIN * np.abs(trend)


def _between(solved: IndexArray, wrong: IndexArray) -> IndexArray:
    """Middles of the intervals on both sides of some solved frequencies."""
    neighbours = np.unique(np.concatenate([wrong - 1, wrong]))
    neighbours = neighbours[(neighbours >= 0) & (neighbours < solved.size - 1)]
    low, high = solved[neighbours], solved[neighbours + 1]
    return np.asarray(((low + high) // 2)[high - low > 1])


def _trend(frequency_hz: Array, delay_s: Array) -> ComplexArray:
    """Delay and growth that are taken out: j omega exp(-j omega d), (frequency, receiver, 1)."""
    omega = 2.0 * np.pi * frequency_hz[:, None, None]
    return np.asarray(1j * omega * np.exp(-1j * omega * delay_s[:, None]))


def _spline(frequency_hz: Array, smooth: ComplexArray, wanted_hz: Array) -> ComplexArray:
    """Spline through both halves of the spectrum."""
    two_sided_hz = np.concatenate([-frequency_hz[::-1], frequency_hz])
    values = np.concatenate([smooth[::-1].conj(), smooth])
    degree = min(_DEGREE, two_sided_hz.size - 1)
    return np.asarray(
        make_interp_spline(two_sided_hz, values, k=degree - 1 + degree % 2)(wanted_hz)
    )


def _left_out(frequency_hz: Array, smooth: ComplexArray) -> Array:
    """Error at every solved frequency but the last, if it is omitted with every other one."""
    error = np.zeros(smooth.shape)
    for start in (0, 1):
        out = np.arange(start, frequency_hz.size - 1, 2)
        kept = np.setdiff1d(np.arange(frequency_hz.size), out)
        estimate = _spline(frequency_hz[kept], smooth[kept], frequency_hz[out])
        error[out] = np.abs(estimate - smooth[out])
    if frequency_hz.size > 1:
        error[-1] = error[-2]
    return error


def _everywhere(
    table_hz: Array,
    delay_s: Array,
    solved: IndexArray,
    smooth: ComplexArray,
    error: Array,
    beside: Array,
) -> Sampled:
    """Interpolated pressures; the larger error of both solved neighbours."""
    solved_hz = table_hz[solved]
    pressure = _spline(solved_hz, smooth, table_hz) * _trend(table_hz, delay_s)
    upper = np.minimum(np.searchsorted(solved, np.arange(table_hz.size)), solved.size - 1)
    lower = np.where(solved[upper] > np.arange(table_hz.size), upper - 1, upper)
    share = (table_hz / solved_hz[lower])[:, None, None]
    total = share * np.maximum(error[lower], error[upper])
    between = (lower != upper)[:, None, None]
    total = total + between * share * np.maximum(beside[lower], beside[upper])
    return Sampled(pressure, total, solved)
