"""A damped pendulum whose pivot moves to and fro: the periodic motion that it settles in."""

from dataclasses import dataclass
from functools import cache
from math import pi, sqrt

import numpy as np

from ..base.arrays import Array
from ..base.constants import STANDARD_GRAVITY_M_PER_S2
from ..base.errors import SolverError
from .pendulum_steps import states_at

SETTLING_REVOLUTIONS = 300
SETTLING_ROUNDS = 4
"""Of so many revolutions each, until Newton's method leads to a stable motion."""
SETTLING_STEPS = 32
"""Of order eight, in a revolution."""
REVOLUTION_STEPS = 96
"""The error of a revolution is below 1e-12 rad."""
NEWTON_STEPS = 30
STATE_TOLERANCE = 1e-11

State = tuple[float, float]
"""Angle from the vertical, rad, and its rate per radian of crank angle."""


@dataclass(frozen=True)
class Drive:
    """A pendulum whose pivot moves as x = stroke cos(2π f t).

    φ'' + 2ζ(ω_n/ω) φ' + (ω_n/ω)² sin φ + (x_b''/l) cos φ = 0 (corrected thesis 7.1), the prime
    for d/dθ of the crank angle θ. In a level plane weight does nothing: ω_n/ω of the weight is 0,
    that of the damping 1.
    """

    length_m: float
    damping_ratio: float
    stroke_m: float
    frequency_hz: float
    level: bool = False

    @property
    def natural_ratio(self) -> float:
        """Natural frequency of the hanging pendulum over the shaft frequency; 0 where it lies."""
        if self.level:
            return 0.0
        return sqrt(STANDARD_GRAVITY_M_PER_S2 / self.length_m) / (2.0 * pi * self.frequency_hz)

    @property
    def motion(self) -> tuple[float, float, float]:
        """Push x_b/l, stiffness (ω_n/ω)² and damping 2ζ ω_n/ω of the equation of motion."""
        ratio = self.natural_ratio
        damping = 2.0 * self.damping_ratio * (1.0 if self.level else ratio)
        return self.stroke_m / self.length_m, ratio**2, damping


@cache
def settle(drive: Drive) -> State:
    """State at crank angle zero of the periodic motion that follows a start near hanging.

    At a few speeds that start leads to a motion that repeats only after several revolutions; there
    it is the periodic motion that follows a start at rest on the horizontal.

    Raises
    ------
    SolverError
        The motion does not become periodic, or only an unstable one was found.
    """
    for start in ((-drive.stroke_m / drive.length_m + 1e-3, 0.0), (0.5 * pi, 0.0)):
        state = start
        for _ in range(SETTLING_ROUNDS):
            state = _after_settling(drive, state)
            periodic = _stable_state(drive, state)
            if periodic is not None:
                return periodic
    raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz settles in no stable motion")


def _after_settling(drive: Drive, state: State) -> State:
    end = np.array([2.0 * pi * SETTLING_REVOLUTIONS])
    longest = 2.0 * pi / SETTLING_STEPS
    angle, rate = states_at(end, np.array(state), longest, drive.motion)[0]
    return float(angle), float(rate)


def _stable_state(drive: Drive, guess: State) -> State | None:
    """The periodic state that Newton's method finds from a guess, if it is a stable one."""
    try:
        state = periodic_state(drive, guess)
    except SolverError:
        return None
    return state if multiplier(drive, state) < 1.0 else None


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


def multiplier(drive: Drive, state: State) -> float:
    """Largest growth of a small deviation per revolution (Floquet); above one is unstable."""
    tangent = revolution(drive, np.array(state))[1]
    return float(np.max(np.abs(np.linalg.eigvals(tangent))))


def revolution(drive: Drive, state: Array) -> tuple[Array, Array]:
    """State after one revolution and its derivative with respect to the state before."""
    start = np.array([*state, 1.0, 0.0, 0.0, 1.0])
    end = states_at(np.array([2.0 * pi]), start, 2.0 * pi / REVOLUTION_STEPS, drive.motion)[0]
    return end[:2], end[2:].reshape(2, 2).T


def swing(drive: Drive, state: State, crank_angle: Array) -> Array:
    """Angle of the pendulum from the vertical, rad, at rising crank angles from zero."""
    longest = 2.0 * pi / REVOLUTION_STEPS
    return np.asarray(states_at(crank_angle, np.array(state), longest, drive.motion)[:, 0])
