"""Steady rotation of a crankshaft whose inertia and load change with crank angle."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import brentq

from ..base.arrays import Array
from ..base.errors import ParameterError, SolverError
from .moving_parts import Revolution, Wrench
from .rotation import Rotation

ITERATIONS: Final = 200
SPEED_TOLERANCE: Final = 1e-13
"""Largest relative change of the speed in the last iteration."""


@dataclass(frozen=True)
class DrivenRotation(Rotation):
    """Periodic rotation of a crankshaft that a motor drives.

    Attributes
    ----------
    motor_torque_n_m : shape (samples,)
    """

    motor_torque_n_m: Array


def planar(force_n: Array, roll_moment_n_m: Array) -> Wrench:
    """Wrench of a mechanism that moves in the plane across its shaft.

    Parameters
    ----------
    force_n : along and across the stroke, shape (2, samples)
    roll_moment_n_m : about the shaft, shape (samples,)
    """
    still = np.zeros_like(roll_moment_n_m)
    return Wrench(np.stack([*force_n, still]), np.stack([still, still, roll_moment_n_m]))


def every(
    stride: int,
    speed_rpm: float,
    rotation: Rotation,
    wrenches: Mapping[str, Wrench],
    figures: Mapping[str, float],
) -> Revolution:
    """A revolution at every so many of the crank angles at which it was solved."""
    return Revolution(
        speed_rpm,
        Rotation(rotation.speed_rad_per_s[::stride], rotation.acceleration_rad_per_s2[::stride]),
        {
            name: Wrench(wrench.force_n[:, ::stride], wrench.moment_n_m[:, ::stride])
            for name, wrench in wrenches.items()
        },
        figures,
    )


def acceleration_of(position: Array, rotation: Rotation) -> Array:
    """Second derivative to time of a place or angle given over crank angle.

    Parameters
    ----------
    position : value, first and second derivative over crank angle, shape (3, samples)
    rotation : rotation of the crankshaft
    """
    speed, acceleration = rotation.speed_rad_per_s, rotation.acceleration_rad_per_s2
    return np.asarray(position[2] * speed**2 + position[1] * acceleration)


def reduced_inertia(
    crankshaft_inertia_kg_m2: float, moving: Sequence[tuple[float, Array]]
) -> tuple[Array, Array]:
    """Inertia of all moving parts reduced to the crankshaft, and its slope over crank angle.

    Parameters
    ----------
    crankshaft_inertia_kg_m2 : inertia of all that turns with the crankshaft
    moving : mass or inertia and its position or angle, shape (3, samples) as `acceleration_of`

    Returns
    -------
    inertia, slope : shape (samples,), kg m² and kg m²/rad
    """
    inertia = crankshaft_inertia_kg_m2 + sum(mass * value[1] ** 2 for mass, value in moving)
    slope = sum(2.0 * mass * value[1] * value[2] for mass, value in moving)
    return np.asarray(inertia), np.asarray(slope)


def steady_rotation(
    inertia_kg_m2: Array,
    inertia_slope_kg_m2: Array,
    load_torque_n_m: Array,
    mean_speed_rad_per_s: float,
    motor_slope_ratio: float,
) -> DrivenRotation:
    """Periodic solution of I θ̈ + ½ (dI/dθ) θ̇² = M_D - L (Eksergian's equation).

    The kinetic energy ½ I θ̇² is the integral of M_D - L over crank angle, by the trapezoidal
    rule. The motor's torque is M (1 + s (θ̇/Ω - 1)); M follows from the balance of a revolution.

    Parameters
    ----------
    inertia_kg_m2 : I, inertia of all moving parts reduced to the crankshaft, shape (samples,),
        over uniform crank angles of one revolution
    inertia_slope_kg_m2 : dI/dθ, shape (samples,), kg m²/rad
    load_torque_n_m : L, positive against the rotation, shape (samples,)
    mean_speed_rad_per_s : Ω, mean over time
    motor_slope_ratio : s, 1 for a torque proportional to the speed, 0 for a constant one

    Raises
    ------
    ParameterError
        The flywheel effect cannot carry the shaft through the revolution at this speed.
    SolverError
        The iteration for the motor's torque does not converge.
    """
    speed = np.full_like(inertia_kg_m2, mean_speed_rad_per_s)
    energy = np.zeros_like(speed)
    mean_energy = 0.5 * float(np.mean(inertia_kg_m2)) * mean_speed_rad_per_s**2
    restoring = -0.5 * motor_slope_ratio * float(np.mean(load_torque_n_m)) / mean_energy
    for _ in range(ITERATIONS):
        shape = 1.0 + motor_slope_ratio * (speed / mean_speed_rad_per_s - 1.0)
        motor = shape * np.mean(load_torque_n_m) / np.mean(shape)
        before = speed
        surplus = motor - load_torque_n_m
        energy = _energy(surplus, energy, max(restoring, 0.0))
        speed = _speed(inertia_kg_m2, energy, mean_speed_rad_per_s)
        if np.max(np.abs(speed - before)) < SPEED_TOLERANCE * mean_speed_rad_per_s:
            acceleration = (surplus - 0.5 * inertia_slope_kg_m2 * speed**2) / inertia_kg_m2
            return DrivenRotation(speed, acceleration, motor)
    raise SolverError(f"motor_slope_ratio = {motor_slope_ratio:g}: no steady rotation found")


def _energy(surplus: Array, before: Array, restoring: float) -> Array:
    """Periodic solution of E' + k E = surplus + k E_before, by the trapezoidal rule.

    The motor's loss k of torque per energy gained (1/rad) is solved for and not iterated, so that a
    stiff motor on a light rotor converges too. Where E repeats, it is the integral of the surplus.
    """
    step = 2.0 * np.pi / surplus.size
    order = np.arange(1, surplus.size // 2 + 1)
    spectrum = np.fft.rfft(surplus + restoring * before)
    spectrum[1:] /= 2.0j / step * np.tan(0.5 * step * order) + restoring
    spectrum[0] = 0.0
    return np.asarray(np.fft.irfft(spectrum, n=surplus.size))


def _speed(inertia: Array, energy: Array, mean_speed: float) -> Array:
    """Speed with the given mean over time of a kinetic energy known up to a constant, rad/s."""
    deficit = -float(np.min(energy))
    reference = 0.5 * float(np.max(inertia)) * mean_speed**2

    def excess(constant: float) -> float:
        speed = np.sqrt(2.0 * (energy + constant) / inertia)
        return float(1.0 / np.mean(1.0 / speed) - mean_speed)

    lowest, highest = deficit + 1e-6 * reference, deficit + float(np.ptp(energy)) + 2.0 * reference
    if excess(lowest) > 0.0:
        raise ParameterError(
            f"speed_rpm = {mean_speed * 30.0 / np.pi:.4g} rpm: the moving parts' inertia does not "
            "carry the crankshaft through a revolution; raise the inertia or the speed"
        )
    constant = brentq(excess, lowest, highest, xtol=1e-14 * reference, rtol=1e-14)
    return np.asarray(np.sqrt(2.0 * (energy + constant) / inertia))
