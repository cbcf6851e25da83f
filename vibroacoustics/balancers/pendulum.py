"""Pendulums hung from the Oldham ring (thesis 7.1): the driven nonlinear pendulum."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from ..constants import STANDARD_GRAVITY_M_PER_S2
from ..errors import ParameterError, SolverError
from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.machine import Machine
from ..parameters.options import Pendulum
from ..units import shaft_frequency_hz

SETTLING_REVOLUTIONS = 300
NEWTON_STEPS = 30
STATE_TOLERANCE = 1e-11


def pendulum(option: Pendulum, machine: Machine, speed_rpm: float, crank_angle: Array) -> Balancing:
    """Two equal pendulums on the ring, in the periodic state that they settle in.

    Both bobs are taken on the same side, so that their vertical forces add. Their arms to either
    side of the ring are equal: one bob of the total mass in the middle makes the same force and
    moment.

    Raises
    ------
    SolverError
        No periodic state was found.
    """
    stroke = machine.kinematics.orbit_radius_m
    mass = pendulum_mass(stroke, machine.oldham.mass_kg, option.horizontal_reach_m)
    drive = Drive(option.length_m, option.damping_ratio, stroke, shaft_frequency_hz(speed_rpm))
    settled = settle(drive)
    hanging = periodic_state(drive, np.array([-stroke / option.length_m, 0.0]))
    angle = swing(drive, settled, crank_angle)
    bob = path(
        stroke * np.cos(crank_angle) + option.length_m * np.sin(angle),
        0.0,
        machine.oldham.height_m - option.length_m * np.cos(angle),
    )
    return Balancing(
        (MovingPart("balancer", mass, bob),),
        {
            "added_mass_kg": mass,
            "settled_angle_deg": float(np.rad2deg(np.mean(angle))),
            "hanging_multiplier": float(np.max(np.abs(floquet_multipliers(drive, hanging)))),
            "settled_multiplier": float(np.max(np.abs(floquet_multipliers(drive, settled)))),
        },
    )


def pendulum_mass(stroke_m: float, ring_mass_kg: float, horizontal_reach_m: float) -> float:
    """Total bob mass of thesis (7.5) and (7.10): m = x_b M / (l_h - x_b), kg.

    Raises
    ------
    ParameterError
        The bobs cannot swing farther out than the ring moves.
    """
    if horizontal_reach_m <= stroke_m:
        raise ParameterError(
            f"horizontal_reach_mm = {1e3 * horizontal_reach_m:g} mm: must exceed the "
            f"ring's stroke amplitude of {1e3 * stroke_m:g} mm"
        )
    return stroke_m * ring_mass_kg / (horizontal_reach_m - stroke_m)


@dataclass(frozen=True)
class Drive:
    """A pendulum whose pivot moves as x = stroke cos(2π f t)."""

    length_m: float
    damping_ratio: float
    stroke_m: float
    frequency_hz: float

    def slope(self, crank_angle: float, state: Array) -> Array:
        """d(angle, rate)/dθ with rate = d(angle)/dθ.

        φ'' + 2ζ(ω_n/ω) φ' + (ω_n/ω)² sin φ + (x_b''/l) cos φ = 0 (corrected thesis 7.1).
        """
        angle, rate = state
        ratio, push = self._coefficients(crank_angle)
        return np.array(
            [
                rate,
                -2.0 * self.damping_ratio * ratio * rate
                - ratio**2 * np.sin(angle)
                - push * np.cos(angle),
            ]
        )

    def variation(self, crank_angle: float, angle: float) -> Array:
        """Derivative of `slope` with respect to the state, shape (2, 2)."""
        ratio, push = self._coefficients(crank_angle)
        stiffness = -(ratio**2) * np.cos(angle) + push * np.sin(angle)
        return np.array([[0.0, 1.0], [stiffness, -2.0 * self.damping_ratio * ratio]])

    def _coefficients(self, crank_angle: float) -> tuple[float, float]:
        """Natural over shaft frequency, and the pivot's acceleration over length."""
        natural = np.sqrt(STANDARD_GRAVITY_M_PER_S2 / self.length_m)
        ratio = natural / (2.0 * np.pi * self.frequency_hz)
        return ratio, -self.stroke_m / self.length_m * np.cos(crank_angle)


def settle(drive: Drive) -> Array:
    """State at crank angle zero of the periodic motion that follows a start near hanging."""
    start = np.array([-drive.stroke_m / drive.length_m + 1e-3, 0.0])
    end = 2.0 * np.pi * SETTLING_REVOLUTIONS
    solution = solve_ivp(
        drive.slope, (0.0, end), start, method="LSODA", rtol=1e-8, atol=1e-10, t_eval=[end]
    )
    state = periodic_state(drive, solution.y[:, -1])
    if np.max(np.abs(floquet_multipliers(drive, state))) >= 1.0:
        raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz settles in no stable motion")
    return state


def periodic_state(drive: Drive, guess: Array) -> Array:
    """Fixed point of the once-per-revolution map, by Newton's method from a guess.

    Raises
    ------
    SolverError
        Newton's method does not converge.
    """
    state = np.array(guess, dtype=float)
    for _ in range(NEWTON_STEPS):
        after, tangent = revolution(drive, state)
        step = np.linalg.solve(tangent - np.eye(2), state - after)
        state = state + step
        if np.max(np.abs(step)) < STATE_TOLERANCE:
            return state
    raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz: no periodic motion found")


def floquet_multipliers(drive: Drive, state: Array) -> Array:
    """Growth of small deviations per revolution; above one in magnitude is unstable."""
    return np.asarray(np.linalg.eigvals(revolution(drive, state)[1]))


def revolution(drive: Drive, state: Array) -> tuple[Array, Array]:
    """State after one revolution and its derivative with respect to the state before."""

    def slope(crank_angle: float, extended: Array) -> Array:
        tangent = drive.variation(crank_angle, extended[0]) @ extended[2:].reshape(2, 2)
        return np.concatenate([drive.slope(crank_angle, extended[:2]), tangent.ravel()])

    start = np.concatenate([state, np.eye(2).ravel()])
    end = solve_ivp(slope, (0.0, 2.0 * np.pi), start, method="DOP853", rtol=1e-12, atol=1e-13).y[
        :, -1
    ]
    return np.asarray(end[:2]), np.asarray(end[2:].reshape(2, 2))


def swing(drive: Drive, state: Array, crank_angle: Array) -> Array:
    """Angle of the pendulum from the vertical over one revolution, rad."""
    return np.asarray(
        solve_ivp(
            drive.slope,
            (0.0, 2.0 * np.pi),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-13,
            t_eval=crank_angle,
            max_step=0.1,
        ).y[0]
    )
