"""Compiled integration of a driven pendulum, in steps of order eight (Dormand & Prince).

E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, Springer 1993,
section II.10. The coefficients are those of scipy's DOP853.
"""

from math import ceil, cos, sin
from typing import Final

import numba
import numpy as np
from scipy.integrate import DOP853

from ..base.arrays import Array

STAGES: Final = int(DOP853.n_stages)
NODES: Final = np.array(DOP853.C[:STAGES], dtype=float)
STAGE_WEIGHTS: Final = np.array(DOP853.A[:STAGES, :STAGES], dtype=float)
WEIGHTS: Final = np.array(DOP853.B[:STAGES], dtype=float)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def states_at(
    crank_angle: Array, start: Array, longest_step: float, motion: tuple[float, float, float]
) -> Array:
    """State at each of the rising crank angles, shape (angle, component).

    Parameters
    ----------
    crank_angle : not below zero, rad
    start : at crank angle zero: angle and rate; and, where they are wanted, the deviations of
        angle and rate that follow a small change of the first, then of the second starting value
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
