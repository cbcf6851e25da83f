"""Gas of an opened pair of pockets, of chamber and plenum, with flows that have inertia.

Compressible gas in each volume, ρ = ρ_d (p/p_d)^(1/κ); in gap and port the unsteady flow of a short
passage, (l/A) dm/dt = Δp - m|m|/(2 ρ (C A)²), with the density where it comes from.
"""

from typing import Any, Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...mechanics.runge_kutta import stage_of

STATES: Final = 5
PAIR, CHAMBER, PLENUM, GAP_FLOW, PORT_FLOW = range(STATES)
"""Rows of a state: pressures in pair, chamber and plenum, Pa; mass flows from pair to chamber and
from chamber to plenum, kg/s."""


class OpeningConstants(NamedTuple):
    """Constants of the equations in SI units; numba takes named tuples, not dataclasses."""

    angular_speed: float
    swept_volume: float
    outer_contact: float
    inner_contact: float
    chamber_volume: float
    plenum_volume: float
    gap_area: float
    gap_length: float
    port_area: float
    port_length: float
    discharge_coefficient: float
    tube_admittance: float
    """Cross-section over speed of sound, kg/s per Pa."""
    mean_flow: float
    pressure: float
    density: float
    stiffness_exponent: float
    """κ = ρ c²/p of the gas at discharge."""


@numba.njit(cache=True, nogil=True, error_model="numpy")
def density(pressure: float, c: Any) -> float:
    """Density of the gas at a pressure, kg/m³."""
    return float(c.density * (pressure / c.pressure) ** (1.0 / c.stiffness_exponent))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def pressure_rise(
    pressure: float, rho: float, volume: float, swelling: float, inflow: float, c: Any
) -> float:
    """dp/dt = κ p/V (inflow/ρ - dV/dt), Pa/s."""
    return float(c.stiffness_exponent * pressure / volume * (inflow / rho - swelling))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def flow_rise(flow: float, drop: float, rho: float, area: float, length: float, c: Any) -> float:
    """dm/dt through a passage, kg/s²; none through a closed one."""
    if area <= 0.0:
        return 0.0
    loss = flow * abs(flow) / (2.0 * rho * (c.discharge_coefficient * area) ** 2)
    return float((drop - loss) * area / length)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def opening_rate(
    angle: float, joined: bool, state: Array, leak: float, c: OpeningConstants, rate: Array
) -> None:
    """Change of a state per radian, into `rate`.

    Parameters
    ----------
    angle : crank angle since the opening, 0 to 2π, rad
    joined : pair and chamber are one, with the pressure of the chamber
    state : shape (5,)
    leak : out of the pair, later out of the chamber, to the pockets outside, kg/s
    c : constants
    rate : shape (5,); it is changed
    """
    pair, chamber, plenum = state[PAIR], state[CHAMBER], state[PLENUM]
    chamber_density, plenum_density = density(chamber, c), density(plenum, c)
    through_port, through_gap = state[PORT_FLOW], 0.0 if joined else state[GAP_FLOW]
    ends_at = (c.outer_contact if joined else c.inner_contact) - angle
    volume = c.chamber_volume + 0.5 * c.swept_volume * (ends_at**2 - c.inner_contact**2)
    swelling = -c.swept_volume * ends_at * c.angular_speed
    inflow = through_gap - through_port - (leak if joined else 0.0)
    rate[CHAMBER] = pressure_rise(chamber, chamber_density, volume, swelling, inflow, c)
    rate[PAIR], rate[GAP_FLOW] = rate[CHAMBER], 0.0
    if not joined:
        around = 2.0 * np.pi * c.swept_volume
        volume, rho = around * (c.outer_contact - np.pi - angle), density(pair, c)
        out = through_gap + leak
        rate[PAIR] = pressure_rise(pair, rho, volume, -around * c.angular_speed, -out, c)
        area = c.gap_area * (1.0 - np.cos(angle))
        rho = rho if through_gap > 0.0 else chamber_density
        rate[GAP_FLOW] = flow_rise(through_gap, pair - chamber, rho, area, c.gap_length, c)
    out = c.mean_flow + c.tube_admittance * (plenum - c.pressure)
    rate[PLENUM] = pressure_rise(
        plenum, plenum_density, c.plenum_volume, 0.0, through_port - out, c
    )
    rho = chamber_density if through_port > 0.0 else plenum_density
    rate[PORT_FLOW] = flow_rise(through_port, chamber - plenum, rho, c.port_area, c.port_length, c)
    for n in range(STATES):
        rate[n] /= c.angular_speed


@numba.njit(cache=True, nogil=True, error_model="numpy")
def join(state: Array, c: OpeningConstants) -> None:
    """Make pair and chamber one after half a turn: their mass is kept, the jet is lost."""
    pair = 2.0 * np.pi * c.swept_volume * (c.outer_contact - 2.0 * np.pi)
    open_share = (c.inner_contact - np.pi) ** 2 - c.inner_contact**2
    chamber = c.chamber_volume + 0.5 * c.swept_volume * open_share
    mass = pair * density(state[PAIR], c) + chamber * density(state[CHAMBER], c)
    rho = mass / (pair + chamber)
    state[CHAMBER] = c.pressure * (rho / c.density) ** c.stiffness_exponent
    state[PAIR], state[GAP_FLOW] = state[CHAMBER], 0.0


@numba.njit(cache=True, nogil=True, error_model="numpy")
def one_turn(start: Array, steps: int, leak: Array, c: OpeningConstants) -> Array:
    """States over a turn from an opening, by classical Runge-Kutta steps of fourth order.

    Parameters
    ----------
    start : shape (5,)
    steps : number of steps of the turn, even
    leak : out of pair and chamber at half steps, shape (2 steps + 1,), kg/s
    c : constants

    Returns
    -------
    shape (5, steps + 1); the state half a turn on is that of pair and chamber as one
    """
    states = np.empty((STATES, steps + 1))
    state, trial, rate = np.empty(STATES), np.empty(STATES), np.empty(STATES)
    for n in range(STATES):
        state[n] = states[n, 0] = start[n]
    step = 2.0 * np.pi / steps
    for number in range(steps):
        joined = 2 * number >= steps
        for n in range(STATES):
            trial[n] = state[n]
        for stage in range(4):
            half, reach, weight = stage_of(stage, step)
            angle, lost = number * step + 0.5 * half * step, leak[2 * number + half]
            opening_rate(angle, joined, trial, lost, c, rate)
            for n in range(STATES):
                trial[n] = states[n, number] + reach * rate[n]
                state[n] += weight * rate[n]
        if 2 * (number + 1) == steps:
            join(state, c)
        for n in range(STATES):
            states[n, number + 1] = state[n]
    return states
