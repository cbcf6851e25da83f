"""Pendulums hung from the Oldham ring (thesis 7.1): the driven nonlinear pendulum."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import cos, pi, sin, sqrt

import numpy as np
from scipy.integrate import solve_ivp

from ..constants import STANDARD_GRAVITY_M_PER_S2
from ..errors import ParameterError, SolverError
from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import Pendulum
from ..units import shaft_frequency_hz

SETTLING_REVOLUTIONS = 300
NEWTON_STEPS = 30
STATE_TOLERANCE = 1e-11

State = tuple[float, float]
"""Angle from the vertical, rad, and its rate per radian of crank angle."""


def pendulum(
    option: Pendulum, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
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
    hanging = periodic_state(drive, (-stroke / option.length_m, 0.0))
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
            "settled_angle_deg": float(np.rad2deg(abs(np.mean(angle)))),
            "hanging_multiplier": multiplier(drive, hanging),
            "settled_multiplier": multiplier(drive, settled),
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

    @cached_property
    def natural_ratio(self) -> float:
        """Natural frequency of the hanging pendulum over the shaft frequency."""
        return sqrt(STANDARD_GRAVITY_M_PER_S2 / self.length_m) / (2.0 * pi * self.frequency_hz)

    def slope(self, crank_angle: float, state: Sequence[float]) -> State:
        """d(angle, rate)/dθ with rate = d(angle)/dθ.

        φ'' + 2ζ(ω_n/ω) φ' + (ω_n/ω)² sin φ + (x_b''/l) cos φ = 0 (corrected thesis 7.1).
        """
        angle, rate = state
        ratio = self.natural_ratio
        push = self.stroke_m / self.length_m * cos(crank_angle)
        damping = 2.0 * self.damping_ratio * ratio * rate
        return rate, push * cos(angle) - ratio**2 * sin(angle) - damping

    def extended_slope(self, crank_angle: float, extended: Sequence[float]) -> tuple[float, ...]:
        """Slope of the state and of its derivatives with respect to the two starting values."""
        angle, rate, *deviations = extended
        ratio = self.natural_ratio
        push = self.stroke_m / self.length_m * cos(crank_angle)
        stiffness = -(ratio**2) * cos(angle) - push * sin(angle)
        damping = -2.0 * self.damping_ratio * ratio
        first, second, first_rate, second_rate = deviations
        return (
            *self.slope(crank_angle, (angle, rate)),
            first_rate,
            second_rate,
            stiffness * first + damping * first_rate,
            stiffness * second + damping * second_rate,
        )


@cache
def settle(drive: Drive) -> State:
    """State at crank angle zero of the periodic motion that follows a start near hanging.

    Raises
    ------
    SolverError
        The motion does not become periodic, or only an unstable one was found.
    """
    start = (-drive.stroke_m / drive.length_m + 1e-3, 0.0)
    end = 2.0 * pi * SETTLING_REVOLUTIONS
    solution = solve_ivp(
        drive.slope, (0.0, end), start, method="LSODA", rtol=1e-8, atol=1e-10, t_eval=[end]
    )
    state = periodic_state(drive, tuple(solution.y[:, -1]))
    if multiplier(drive, state) >= 1.0:
        raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz settles in no stable motion")
    return state


@cache
def periodic_state(drive: Drive, guess: State) -> State:
    """Fixed point of the once-per-revolution map, by Newton's method from a guess.

    Raises
    ------
    SolverError
        Newton's method does not converge.
    """
    state = np.array(guess)
    for _ in range(NEWTON_STEPS):
        after, tangent = revolution(drive, state)
        try:
            step = np.linalg.solve(tangent - np.eye(2), state - after)
        except np.linalg.LinAlgError:  # a bifurcation: the motion is not isolated
            break
        state = state + step
        if np.max(np.abs(step)) < STATE_TOLERANCE:
            return float(state[0]), float(state[1])
    raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz: no periodic motion found")


@cache
def multiplier(drive: Drive, state: State) -> float:
    """Largest growth of a small deviation per revolution (Floquet); above one is unstable."""
    tangent = revolution(drive, np.array(state))[1]
    return float(np.max(np.abs(np.linalg.eigvals(tangent))))


def revolution(drive: Drive, state: Array) -> tuple[Array, Array]:
    """State after one revolution and its derivative with respect to the state before."""
    start = (*state, 1.0, 0.0, 0.0, 1.0)
    end = _integrate(drive.extended_slope, start, np.array([2.0 * pi]))[:, -1]
    return np.asarray(end[:2]), np.asarray(end[2:].reshape(2, 2))


def swing(drive: Drive, state: State, crank_angle: Array) -> Array:
    """Angle of the pendulum from the vertical over one revolution, rad."""
    return np.asarray(_integrate(drive.slope, state, crank_angle)[0])


def _integrate(
    slope: Callable[..., Sequence[float]], start: Sequence[float], crank_angle: Array
) -> Array:
    """Solution at crank angles from zero to one revolution, to nearly rounding."""
    solution = solve_ivp(
        slope,
        (0.0, 2.0 * pi),
        start,
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=crank_angle,
        max_step=0.1,
    )
    return np.asarray(solution.y)
