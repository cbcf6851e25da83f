"""Moving parts and the force and moment that they make on the housing.

Every kinematic machine and every balancer is a list of moving parts. Rigid-body motion of the
housing is excited by their change of momentum only: gas, contact and bearing forces are internal
pairs and cancel in the resultant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MovingPart:
    """A rigid part that translates along a closed path, relative to the housing.

    Attributes
    ----------
    source : who makes the force, as in the results
    mass_kg : mass
    position_m : centre of mass over one revolution, shape (3, samples); x, y, z from the
        machine's centre of mass at rest, uniformly sampled from crank angle zero
    """

    source: str
    mass_kg: float
    position_m: Array


@dataclass(frozen=True)
class Balancing:
    """What a balancing option adds: moving parts and the figures to report of it."""

    parts: tuple[MovingPart, ...] = ()
    facts: Mapping[str, float] = field(default_factory=dict)
    """Figures by name; the unit is the suffix of the name."""


def path(x: Array | float, y: Array | float, z: Array | float) -> Array:
    """Stack coordinates, constant ones broadcast, to a path of shape (3, samples)."""
    return np.stack(np.broadcast_arrays(*map(np.asarray, (x, y, z)))).astype(float)


def second_derivative(periodic: Array) -> Array:
    """Second derivative with respect to crank angle, by Fourier series along the last axis.

    Exact for a signal that is band-limited below half the number of samples per revolution.
    """
    samples = periodic.shape[-1]
    orders = np.arange(samples // 2 + 1)
    # Without its mean, which would only add rounding errors.
    spectrum = np.fft.rfft(periodic - periodic.mean(axis=-1, keepdims=True), axis=-1)
    return np.asarray(np.fft.irfft(-(orders**2) * spectrum, n=samples, axis=-1))


def wrench(parts: Sequence[MovingPart], shaft_frequency_hz: float) -> tuple[Array, Array]:
    """Force and moment of moving parts on the housing: -Σ m a and -Σ r x m a.

    Parameters
    ----------
    parts : moving parts, all sampled alike
    shaft_frequency_hz : constant shaft frequency, Hz

    Returns
    -------
    force, moment : shape (3, samples), N and N m about the centre of mass at rest
    """
    angular_frequency = 2.0 * np.pi * shaft_frequency_hz
    samples = parts[0].position_m.shape[-1]
    force, moment = np.zeros((3, samples)), np.zeros((3, samples))
    for part in parts:
        acceleration = angular_frequency**2 * second_derivative(part.position_m)
        part_force = -part.mass_kg * acceleration
        force += part_force
        moment += np.cross(part.position_m, part_force, axis=0)
    return force, moment
