"""Moving parts along any course of the crank angle, not at constant speed only."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..mechanics.moving_parts import MovingPart

NO_HARMONIC: Final = 1e-13
"""A harmonic this much smaller than the largest is rounding."""


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
    angle, rate, acceleration : of the part's own angle in time, shape (times,), rad, rad/s, rad/s²

    Returns
    -------
    force, moment : shape (3, times), N and N m about the centre of mass at rest
    """
    position, first, second = path_derivatives(part.position_m, angle)
    force = -part.mass_kg * (second * rate**2 + first * acceleration)
    return force, np.asarray(np.cross(position, force, axis=0))
