"""Crank angle of a shaft over time: what every order analysis is done against."""

from dataclasses import dataclass
from math import factorial

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator, PPoly

from ..base.arrays import Array
from ..base.errors import ParameterError


@dataclass(frozen=True)
class CrankMotion:
    """Crank angle as a smooth function of time that grows everywhere.

    The angle counts from a reference of its own (with a tacho: its first or its index pulse), at
    which the phase of every order is zero.
    """

    curve: PPoly
    """Angle in rad over time in s."""

    @property
    def start_s(self) -> float:
        """First time at which the angle is known."""
        return float(self.curve.x[0])

    @property
    def end_s(self) -> float:
        """Last time at which the angle is known."""
        return float(self.curve.x[-1])

    def angle_rad(self, time_s: Array) -> Array:
        """Crank angle at times within start and end, rad."""
        return np.asarray(self.curve(time_s))

    def frequency_hz(self, time_s: Array) -> Array:
        """Shaft frequency at times within start and end, Hz."""
        return np.asarray(self.curve(time_s, 1)) / (2.0 * np.pi)

    def delayed(self, delay_s: float) -> "CrankMotion":
        """Motion that is later by a time."""
        return CrankMotion(PPoly(self.curve.c, self.curve.x + delay_s))

    def between(self, start_s: float, end_s: float) -> "CrankMotion":
        """Motion that is known between two of its times alone."""
        x, degree = self.curve.x, len(self.curve.c) - 1
        first = int(np.searchsorted(x, start_s, "right")) - 1
        last = int(np.searchsorted(x, end_s, "left"))
        pieces = self.curve.c[:, first:last].copy()
        powers = range(degree, -1, -1)
        pieces[:, 0] = [float(self.curve(start_s, power)) / factorial(power) for power in powers]
        return CrankMotion(PPoly(pieces, np.array([start_s, *x[first + 1 : last], end_s])))

    def geared(self, ratio: float) -> "CrankMotion":
        """Motion of a shaft that turns `ratio` times as fast."""
        return CrankMotion(PPoly(self.curve.c * ratio, self.curve.x))


def constant_speed(frequency_hz: float, start_s: float, end_s: float) -> CrankMotion:
    """A shaft that turns evenly; its angle is zero at time zero.

    Raises
    ------
    ParameterError
        The frequency is not above zero.
    """
    _check_turning(np.array([frequency_hz]))
    speed = 2.0 * np.pi * frequency_hz
    return CrankMotion(PPoly(np.array([[speed], [speed * start_s]]), np.array([start_s, end_s])))


def from_speed(time_s: Array, frequency_hz: Array) -> CrankMotion:
    """A shaft of known speed over time; its angle is zero at the first time.

    The speed between the samples is monotone (PCHIP), so it never overshoots.

    Raises
    ------
    ParameterError
        The speed is not above zero everywhere.
    """
    _check_turning(frequency_hz)
    curve = PchipInterpolator(time_s, 2.0 * np.pi * frequency_hz).antiderivative()
    return CrankMotion(PPoly(curve.c, curve.x))


def from_angle(time_s: Array, angle_rad: Array) -> CrankMotion:
    """A shaft of known angle at some times, by a cubic spline through them.

    Raises
    ------
    ParameterError
        The angle does not grow everywhere.
    """
    return from_curve(CubicSpline(time_s, angle_rad))


def from_curve(curve: PPoly) -> CrankMotion:
    """A shaft whose angle in rad over time in s is a piecewise polynomial."""
    slope = PPoly(curve.c, curve.x).derivative()
    turning_points = slope.derivative().roots(extrapolate=False)
    instants = np.concatenate([curve.x, turning_points[np.isfinite(turning_points)]])
    _check_turning(np.asarray(slope(instants)) / (2.0 * np.pi))
    return CrankMotion(PPoly(curve.c, curve.x))


def _check_turning(frequency_hz: Array) -> None:
    least = float(np.min(frequency_hz))
    if not least > 0.0:
        raise ParameterError(
            f"speed: falls to {60.0 * least:.4g} rpm; order analysis needs a shaft that turns in "
            "one direction without a stop"
        )
