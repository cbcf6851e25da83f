"""Gas of closed pairs of pockets that leak into one another, over a turn from an opening.

Pair 0 has opened; pair j is j turns younger, and across its outer contacts gas flows to pair j + 1.
A pair that has not closed yet fills from the suction.
"""

from typing import NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...mechanics.nozzle import nozzle_flow
from ...mechanics.runge_kutta import stage_of


class LeakingPairs(NamedTuple):
    """Pairs over the crank angle since the opening of pair 0, at half steps.

    Time histories run from `pairs` + 1 turns before an opening to it, those of contacts a turn
    further.
    """

    pairs: int
    """Closed ones at most."""
    steps: int
    """Steps of a turn."""
    closes_at: float
    """Half step at which a pair closes; before, the base pressure is that of suction pockets."""
    base_pa: Array
    """Pressure without leakage."""
    volume_m3: Array
    """Volume of both pockets."""
    area_m2: Array
    """Area of the gaps at the outer contacts, with their losses; zero before the pair has
    closed."""
    polytropic_index: float
    suction_density: float
    isentropic_exponent: float
    """κ of the flow through the gaps."""
    angular_speed: float


@numba.njit(cache=True, nogil=True, error_model="numpy")
def leaks_at(
    half: int, ratio: Array, mass: float, opened: tuple[float, float], p: LeakingPairs, leak: Array
) -> None:
    """Flow across the outer contacts of each pair into `leak`, kg/s.

    Parameters
    ----------
    half : half steps since the opening
    ratio : masses of the pairs 1 to `pairs`, over `mass`, shape (pairs,)
    mass : mass of a pair without leakage, kg
    opened : pressure and density of pair 0
    p : pairs
    leak : shape (pairs + 1,); it is changed
    """
    inner_pa, inner = opened
    for j in range(p.pairs + 1):
        number = (p.pairs - j) * 2 * p.steps + half
        outer_pa, outer = p.base_pa[number], p.suction_density
        if number >= p.closes_at:
            outer_pa *= ratio[j] ** p.polytropic_index
            outer = ratio[j] * mass / p.volume_m3[number]
        area = p.area_m2[number + 2 * p.steps]
        leak[j] = 0.0
        if area > 0.0:
            flow = nozzle_flow(inner_pa, outer_pa, inner, outer, p.isentropic_exponent)
            leak[j] = area * flow
        inner_pa, inner = outer_pa, outer


@numba.njit(cache=True, nogil=True, error_model="numpy")
def leaking_turn(
    start: Array, mass: float, opened_pa: Array, opened_density: Array, p: LeakingPairs
) -> tuple[Array, Array]:
    """Masses of the pairs and flows between them over a turn, by Runge-Kutta steps.

    Parameters
    ----------
    start : masses of the pairs 1 to `pairs` at the opening, over `mass`, shape (pairs,)
    mass : mass of a pair without leakage, kg
    opened_pa, opened_density : pressure and density of pair 0 at half steps, shape (2 steps + 1,)
    p : pairs

    Returns
    -------
    ratios, leaks : shapes (pairs, steps + 1) and (pairs + 1, steps + 1); leaks in kg/s
    """
    ratios, leaks = np.empty((p.pairs, p.steps + 1)), np.empty((p.pairs + 1, p.steps + 1))
    state, trial, rate = start.copy(), start.copy(), np.zeros(p.pairs)
    leak, step = np.empty(p.pairs + 1), 2.0 * np.pi / p.steps
    ratios[:, 0] = start
    for number in range(p.steps):
        trial[:] = state
        for stage in range(4):
            halves, reach, weight = stage_of(stage, step)
            half = 2 * number + halves
            leaks_at(half, trial, mass, (opened_pa[half], opened_density[half]), p, leak)
            if stage == 0:
                leaks[:, number] = leak
            for j in range(p.pairs):
                since = (p.pairs - j) * 2 * p.steps + 2 * (number + 1) - p.closes_at
                closed = min(max(0.5 * since, 0.0), 1.0)  # of this step
                rate[j] = closed * (leak[j] - leak[j + 1]) / (mass * p.angular_speed)
                trial[j] = ratios[j, number] + reach * rate[j]
                state[j] += weight * rate[j]
        ratios[:, number + 1] = state
    last = 2 * p.steps
    leaks_at(last, state, mass, (opened_pa[last], opened_density[last]), p, leak)
    leaks[:, p.steps] = leak
    return ratios, leaks
