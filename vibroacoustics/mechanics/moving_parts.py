"""Moving parts and the force and moment that they make on the housing.

Every kinematic machine and every balancer is a list of moving parts. Rigid-body motion of the
housing is excited by their change of momentum only: gas, contact and bearing forces are internal
pairs and cancel in the resultant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..base.arrays import Array
from .capabilities import UPRIGHT, CrankFrame
from .rotation import Rotation


@dataclass(frozen=True)
class MovingPart:
    """A rigid part that translates along a closed path, relative to the housing.

    Attributes
    ----------
    source : who makes the force, as in the results
    mass_kg : mass
    position_m : centre of mass over one revolution, shape (3, samples); x, y, z from the
        machine's centre of mass at rest, uniformly sampled from crank angle zero

    Examples
    --------
    >>> angle = va.constant_rotation(3000.0, 64).crank_angle
    >>> stroke = 0.01 * np.cos(angle)  # m, along x
    >>> piston = va.MovingPart("piston", 0.2, np.stack([stroke, 0.0 * stroke, 0.0 * stroke]))
    >>> piston.position_m.shape
    (3, 64)
    """

    source: str
    mass_kg: float
    position_m: Array


class Wrench(NamedTuple):
    """Force and moment on the housing over one revolution.

    Attributes
    ----------
    force_n, moment_n_m : shape (3, samples); the moment about the centre of mass at rest

    Examples
    --------
    >>> wrench = va.Wrench(force_n=np.zeros((3, 64)), moment_n_m=np.zeros((3, 64)))
    >>> wrench.force_n.shape
    (3, 64)
    """

    force_n: Array
    moment_n_m: Array

    def placed(self, frame: CrankFrame) -> "Wrench":
        """The wrench in a mechanism's own frame, about its origin, in that of the machine."""
        force = axes_of(frame) @ self.force_n
        moment = axes_of(frame) @ self.moment_n_m
        return Wrench(force, moment + np.cross(np.array(frame.origin_m)[:, None], force, axis=0))


@dataclass(frozen=True)
class Revolution:
    """One steady revolution of a machine.

    Attributes
    ----------
    speed_rpm : mean over time
    rotation : rotation of its shaft
    wrenches : wrench of its moving parts on the housing by change of momentum, by source
    figures : to report of it, such as losses, by name; the unit is the suffix of the name

    Examples
    --------
    >>> rotation = va.constant_rotation(3000.0, 64)
    >>> spot = va.circling("heavy_spot", 0.01, 0.02, 0.0, rotation.crank_angle)
    >>> revolution = va.Revolution(3000.0, rotation, va.wrenches_of_parts([spot], rotation))
    >>> float(np.max(revolution.wrenches["heavy_spot"].force_n).round(3))  # m r ω², N
    19.739
    """

    speed_rpm: float
    rotation: Rotation
    wrenches: Mapping[str, Wrench]
    figures: Mapping[str, float] = field(default_factory=dict)


def path(x: Array | float, y: Array | float, z: Array | float) -> Array:
    """Stack coordinates, constant ones broadcast, to a path of shape (3, samples)."""
    return np.stack(np.broadcast_arrays(*map(np.asarray, (x, y, z)))).astype(float)


def axes_of(frame: CrankFrame) -> Array:
    """Axes of a mechanism in its machine as columns, shape (3, 3)."""
    return np.array([frame.stroke, frame.across, frame.shaft]).T


def circling(
    source: str,
    mass_kg: float,
    radius_m: float,
    height_m: float,
    crank_angle: Array,
    frame: CrankFrame = UPRIGHT,
) -> MovingPart:
    """A mass on a circle about the shaft; a negative radius stands opposite the crank pin.

    Parameters
    ----------
    source : who makes the force, as in the results
    mass_kg : mass
    radius_m : radius of the circle
    height_m : along the shaft from the frame's origin
    crank_angle : uniform over one revolution, shape (samples,), rad
    frame : axes of the mechanism in the machine; default: stroke x, shaft z

    Returns
    -------
    moving part with a path of shape (3, samples), m

    Examples
    --------
    >>> angle = va.constant_rotation(3000.0, 64).crank_angle
    >>> va.circling("balancer", 0.1, -0.02, 0.0, angle).position_m[:, 0].round(3) + 0.0
    array([-0.02, 0. , 0. ])
    """
    circle = path(radius_m * np.cos(crank_angle), radius_m * np.sin(crank_angle), height_m)
    return MovingPart(source, mass_kg, axes_of(frame) @ circle + np.array(frame.origin_m)[:, None])


def derivative(periodic: Array, times: int) -> Array:
    """First or second derivative with respect to crank angle, by Fourier series, last axis.

    Exact for a signal that is band-limited below half the number of samples per revolution.
    """
    samples = periodic.shape[-1]
    factor = (1j * np.arange(samples // 2 + 1)) ** times
    if times % 2 and samples % 2 == 0:
        factor[-1] = 0.0  # a sine of the highest order is zero on these samples
    # Without its mean, which would only add rounding errors.
    spectrum = np.fft.rfft(periodic - periodic.mean(axis=-1, keepdims=True), axis=-1)
    return np.asarray(np.fft.irfft(factor * spectrum, n=samples, axis=-1))


def wrench(parts: Sequence[MovingPart], rotation: Rotation) -> Wrench:
    """Force and moment of moving parts on the housing: -Σ m a and -Σ r x m a.

    Parameters
    ----------
    parts : moving parts, all sampled at the crank angles of the rotation
    rotation : rotation of the shaft
    """
    samples = rotation.speed_rad_per_s.size
    force, moment = np.zeros((3, samples)), np.zeros((3, samples))
    for part in parts:
        acceleration = rotation.speed_rad_per_s**2 * derivative(part.position_m, 2)
        acceleration += rotation.acceleration_rad_per_s2 * derivative(part.position_m, 1)
        part_force = -part.mass_kg * acceleration
        force += part_force
        moment += np.cross(part.position_m, part_force, axis=0)
    return Wrench(force, moment)


def wrenches_of_parts(parts: Sequence[MovingPart], rotation: Rotation) -> dict[str, Wrench]:
    """Return the wrenches of moving parts on the housing, by source in the order of the parts.

    Parameters
    ----------
    parts : moving parts, all sampled at the crank angles of the rotation
    rotation : rotation of the shaft

    Returns
    -------
    force, N, and moment about the centre of mass, N m, over crank angle: -Σ m a and -Σ r × m a

    Examples
    --------
    >>> rotation = va.constant_rotation(3000.0, 64)
    >>> spot = va.circling("heavy_spot", 0.01, 0.02, 0.0, rotation.crank_angle)
    >>> va.wrenches_of_parts([spot], rotation)["heavy_spot"].force_n.shape
    (3, 64)
    """
    by_source: dict[str, list[MovingPart]] = {}
    for part in parts:
        by_source.setdefault(part.source, []).append(part)
    return {name: wrench(same, rotation) for name, same in by_source.items()}
