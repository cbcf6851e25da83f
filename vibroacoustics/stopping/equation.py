"""Equation of motion of a shaft that coasts, with its parts and the gas."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, NamedTuple

import numba
import numpy as np
from scipy.interpolate import CubicSpline

from ..base.arrays import Array
from ..base.periodic_spline import value_and_slope
from ..machine.stopping import Stopping
from ..mechanics.moving_parts import MovingPart

ANGLES: Final = 512
"""Samples a revolution of the reduced inertia."""
NO_HARMONIC: Final = 1e-13
"""A harmonic this much smaller than the largest is rounding."""


class Shift(NamedTuple):
    """Angle of the set ahead of the crank pin and its derivatives in time, rad, rad/s, rad/s²."""

    angle: Array
    rate: Array
    acceleration: Array


class Constants(NamedTuple):
    """Constants of the equation in SI units; numba takes named tuples, not dataclasses.

    The last three are periodic cubic splines over the angle, shape (4, pieces).
    """

    friction: float
    viscous: float
    gas_share: float
    shift: float
    shift_duration: float
    fixed_inertia: Array
    shifted_inertia: Array
    gas_torque: Array


def brake_shift(time_s: Array, shift_rad: float, duration_s: float) -> Shift:
    """A turn from rest to rest with the least jerk, δ (10u³ - 15u⁴ + 6u⁵) with u = t/duration.

    The thesis gives neither time history nor size ("a few degrees"); it is assumed.

    Parameters
    ----------
    time_s : from switch-off, any shape
    shift_rad : δ reached at the end
    duration_s : duration of the turn
    """
    u = np.minimum(np.maximum(time_s / duration_s, 0.0), 1.0)
    return Shift(
        shift_rad * u**3 * (10.0 - 15.0 * u + 6.0 * u**2),
        shift_rad / duration_s * 30.0 * u**2 * (1.0 - u) ** 2,
        shift_rad / duration_s**2 * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    )


_shift_at: Any = numba.njit(cache=True, nogil=True, error_model="numpy")(brake_shift)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def acceleration(
    time: float,
    angle: float,
    speed: float,
    constants: Constants,
    share: float = 1.0,
    turning: float = 1.0,
    push: float = 0.0,
) -> float:
    """Angular acceleration of the shaft, rad/s².

    Parameters
    ----------
    time, angle, speed : time, angle and speed of the shaft
    constants : constants of the equation
    share : share of the gas's torque that remains
    turning : sense in which friction is overcome; 0 leaves it out
    push : torque forwards, N m
    """
    shift, rate, shift_acceleration = _shift_at(time, constants.shift, constants.shift_duration)
    ahead = angle + shift
    fixed, fixed_slope = value_and_slope(constants.fixed_inertia, angle)
    shifted_inertia, moved_slope = value_and_slope(constants.shifted_inertia, ahead)
    gas, _ = value_and_slope(constants.gas_torque, ahead)
    torque = constants.gas_share * share * gas + constants.friction * turning
    torque += constants.viscous * speed + shifted_inertia * shift_acceleration
    torque += 0.5 * fixed_slope * speed**2 + 0.5 * moved_slope * (speed + rate) ** 2
    return float((push - torque) / (fixed + shifted_inertia))


@dataclass(frozen=True)
class Coasting:
    """Equation of motion of the shaft with its parts."""

    stopping: Stopping
    fixed_inertia: CubicSpline
    shifted_inertia: CubicSpline
    gas_torque: CubicSpline

    @classmethod
    def of(
        cls,
        stopping: Stopping,
        parts: Sequence[MovingPart],
        shifted: Collection[str],
        gas_torque_n_m: Array,
    ) -> "Coasting":
        """Return the coasting with the reduced inertia of the parts over a revolution."""
        angle = 2.0 * np.pi * np.arange(ANGLES) / ANGLES
        fixed = inertia_over_angle([part for part in parts if part.source not in shifted], angle)
        shifted_inertia = inertia_over_angle(
            [part for part in parts if part.source in shifted], angle
        )
        curves = fixed + stopping.shaft_inertia_kg_m2, shifted_inertia, gas_torque_n_m
        return cls(stopping, *(_periodic(curve) for curve in curves))

    @cached_property
    def constants(self) -> Constants:
        """Constants as the compiled equation takes them."""
        stopping = self.stopping
        return Constants(
            stopping.friction_torque_n_m,
            stopping.viscous_torque_n_m_s,
            stopping.gas_share_ratio,
            stopping.shift_rad,
            stopping.shift_duration_s,
            self.fixed_inertia.c,
            self.shifted_inertia.c,
            self.gas_torque.c,
        )

    def shift(self, time: Array) -> Shift:
        """Shift of the set against the crank pin."""
        return brake_shift(time, self.stopping.shift_rad, self.stopping.shift_duration_s)

    def inertia_kg_m2(self, time: float, angle: float) -> float:
        """Return the reduced inertia of the shaft and its parts.

        Parameters
        ----------
        time, angle : time and angle of the shaft, s and rad
        """
        ahead = angle + self.shift(np.asarray(time)).angle
        return float(self.fixed_inertia(angle) + self.shifted_inertia(ahead))


def _periodic(values: Array) -> CubicSpline:
    angle = np.linspace(0.0, 2.0 * np.pi, values.size + 1)
    return CubicSpline(angle, np.append(values, values[0]), bc_type="periodic")


def path_derivatives(position_m: Array, angle: Array) -> tuple[Array, Array, Array]:
    """A closed path and its first two derivatives over angle, at any angles.

    Parameters
    ----------
    position_m : over one revolution, shape (3, samples)
    angle : shape (times,), rad

    Returns
    -------
    position, first, second : shape (3, times); exact for a path that is band-limited below half
        the number of samples
    """
    samples = position_m.shape[-1]
    spectrum = np.fft.rfft(position_m, axis=-1)[:, : (samples + 1) // 2] * (2.0 / samples)
    spectrum[:, 0] *= 0.5
    largest = np.max(np.abs(spectrum), axis=0)
    orders = np.flatnonzero(largest > NO_HARMONIC * np.max(largest))
    turning = np.exp(1j * orders[:, None] * angle)

    def derivative(power: int) -> Array:
        return np.asarray(((1j * orders) ** power * spectrum[:, orders] @ turning).real)

    return derivative(0), derivative(1), derivative(2)


def inertia_over_angle(parts: Sequence[MovingPart], angle: Array) -> Array:
    """Σ m |dr/dθ|², inertia of the parts reduced to the shaft, kg m², shape (times,)."""
    total = np.zeros(angle.size)
    for part in parts:
        total += part.mass_kg * np.sum(path_derivatives(part.position_m, angle)[1] ** 2, axis=0)
    return total


def wrench_along(
    part: MovingPart, angle: Array, rate: Array, acceleration: Array
) -> tuple[Array, Array]:
    """Force and moment of a part on the housing, -m a and -r x m a.

    Parameters
    ----------
    part : its path over one revolution
    angle, rate, acceleration : angle, rate and acceleration of the part's own angle in time, shape
        (times,), rad, rad/s, rad/s²

    Returns
    -------
    force, moment : shape (3, times), N and N m about the centre of mass at rest
    """
    position, first, second = path_derivatives(part.position_m, angle)
    force = -part.mass_kg * (second * rate**2 + first * acceleration)
    return force, np.asarray(np.cross(position, force, axis=0))
