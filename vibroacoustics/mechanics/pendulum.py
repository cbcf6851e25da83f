"""A damped pendulum whose pivot moves to and fro: the periodic motion that it settles in."""

from dataclasses import dataclass
from functools import cache
from math import ceil, cos, pi, sin, sqrt
from typing import Final

import numba
import numpy as np
from scipy.integrate import DOP853

from ..base.arrays import Array
from ..base.constants import STANDARD_GRAVITY_M_PER_S2
from ..base.errors import SolverError

SETTLING_REVOLUTIONS = 300
SETTLING_ROUNDS = 4
"""Rounds of so many revolutions each, until Newton's method leads to a stable motion."""
SETTLING_STEPS = 32
"""Steps in a revolution, of order eight."""
REVOLUTION_STEPS = 96
"""The error of a revolution is below 1e-12 rad."""
NEWTON_STEPS = 30
STATE_TOLERANCE = 1e-11
State = tuple[float, float]
"""Angle from the vertical, rad, and its rate per radian of crank angle."""
STAGES: Final = int(DOP853.n_stages)
NODES: Final = np.array(DOP853.C[:STAGES], dtype=float)
STAGE_WEIGHTS: Final = np.array(DOP853.A[:STAGES, :STAGES], dtype=float)
WEIGHTS: Final = np.array(DOP853.B[:STAGES], dtype=float)


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


@numba.njit(cache=True, nogil=True, error_model="numpy")
def states_at(
    crank_angle: Array, start: Array, longest_step: float, motion: tuple[float, float, float]
) -> Array:
    """State at each of the rising crank angles, shape (angle, component).

    Parameters
    ----------
    crank_angle : crank angle, not below zero, shape (angle,), rad
    start : state at crank angle zero, shape (component,): angle and rate; and, where they are
        wanted, the deviations of angle and rate that follow a small change of the first, then of
        the second starting value
    longest_step : rad
    motion : push, stiffness and damping of the equation of motion, see `pendulum.Drive`
    """
    state, trial = start.copy(), np.empty(start.size)
    slopes = np.empty((STAGES, start.size))
    states = np.empty((crank_angle.size, start.size))
    reached = 0.0
    for row in range(crank_angle.size):
        steps = ceil((crank_angle[row] - reached) / longest_step)
        for number in range(steps):
            length = (crank_angle[row] - reached) / steps
            _step(reached + number * length, length, state, motion, slopes, trial)
        reached = crank_angle[row]
        for n in range(start.size):
            states[row, n] = state[n]
    return states


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _step(
    crank_angle: float,
    length: float,
    state: Array,
    motion: tuple[float, float, float],
    slopes: Array,
    trial: Array,
) -> None:
    """Carry the state on by a step; `slopes` and `trial` are overwritten."""
    for stage in range(STAGES):
        for n in range(state.size):
            change = 0.0
            for earlier in range(stage):
                change += STAGE_WEIGHTS[stage, earlier] * slopes[earlier, n]
            trial[n] = state[n] + length * change
        _slope(crank_angle + NODES[stage] * length, trial, motion, slopes[stage])
    for n in range(state.size):
        change = 0.0
        for stage in range(STAGES):
            change += WEIGHTS[stage] * slopes[stage, n]
        state[n] += length * change


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _slope(
    crank_angle: float, state: Array, motion: tuple[float, float, float], slope: Array
) -> None:
    """d(state)/dθ, into `slope`: of angle and rate, then of the deviations in pairs."""
    push, stiffness, damping = motion
    push *= cos(crank_angle)
    sine, cosine = sin(state[0]), cos(state[0])
    slope[0] = state[1]
    slope[1] = push * cosine - stiffness * sine - damping * state[1]
    for n in range(2, state.size, 2):
        slope[n] = state[n + 1]
        slope[n + 1] = -(push * sine + stiffness * cosine) * state[n] - damping * state[n + 1]
