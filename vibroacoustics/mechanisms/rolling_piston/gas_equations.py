"""Compression chamber with discharge reed and leakage over a turn, by Runge-Kutta steps."""

from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...mechanics.nozzle import nozzle_flow
from ...mechanics.runge_kutta import increment

SMALLEST_DIFFERENCE: Final = 1e-4
"""Pressure difference over discharge pressure below which the flow through the valve is linear in
it: the root would be infinitely stiff at zero."""
REACH: Final = 0.5
"""Largest step times the fastest rate of the equations; 2.78 is the limit of the method."""
MOST_STEPS: Final = 2000
RESTING_M_PER_S: Final = 1e-3
"""Speed of the reed below which it rests on seat or stop."""
MEETING: Final = 0.05
"""Distance from seat or stop, over the lift to the stop, at which the reed is about to meet it."""
FINER: Final = 25.0
"""Steps of a reed that meets seat or stop over others: their dampers begin with a jump."""
PRESSURE, MASS, LIFT, SPEED = 0, 1, 2, 3
"""Rows of a state: Pa, kg, m, m/s."""


class Chamber(NamedTuple):
    """Constants of a chamber; time histories are over a turn, both ends included."""

    steps: int
    angular_speed: float
    closes_at: float
    """Angle at which the suction port is passed, rad; before, the pressure is that of suction."""
    volume_m3: Array
    """Clearance included."""
    slope_m3: Array
    """Slope over the crank angle."""
    gap_m2: Array
    """Effective area to the suction chamber."""
    suction_pa: float
    suction_density: float
    discharge_pa: float
    discharge_density: float
    kappa: float
    port_m2: float
    """Area on which the pressure lifts the reed."""
    gap_per_lift_m: float
    """Effective area of the valve over its lift."""
    reed_kg: float
    reed_stiffness: float
    reed_damping: float
    stop_m: float
    seat_stiffness: float
    seat_damping: float


@numba.njit(cache=True, nogil=True, error_model="numpy")
def valve_flow(pressure: float, density: float, lift: float, c: Chamber) -> float:
    """Flow out through the valve, kg/s; negative backwards, linear in the smallest differences.

    Parameters
    ----------
    pressure, density : in the chamber
    lift : lift of the reed, m
    c : constants
    """
    if lift <= 0.0:
        return 0.0
    least = SMALLEST_DIFFERENCE * c.discharge_pa
    difference, share = pressure - c.discharge_pa, 1.0
    inner = pressure
    if abs(difference) < least:
        share = difference / least
        inner = c.discharge_pa + least
    flow = nozzle_flow(inner, c.discharge_pa, density, c.discharge_density, c.kappa)
    return c.gap_per_lift_m * min(lift, c.stop_m) * share * flow


@numba.njit(cache=True, nogil=True, error_model="numpy")
def rates(
    angle: float, p: float, m: float, y: float, v: float, closed: bool, c: Chamber
) -> tuple[float, float, float, float, float]:
    """Rates in time of pressure, mass, lift and its speed, and the fastest of the equations, 1/s.

    Ideal gas without heat: V p' = κ (-p V' - p/ρ Σ out + p_d/ρ_d Σ back); reed: m ÿ = A (p - p_d)
    - k y - c ẏ and what seat and stop push.

    Parameters
    ----------
    angle : rad
    p, m, y, v : pressure, mass, lift and its speed
    closed : whether the suction port is passed
    c : constants
    """
    step = 2.0 * np.pi / c.steps
    number = min(int(angle / step), c.steps - 1)
    t = angle / step - number
    v0, v1 = c.volume_m3[number], c.volume_m3[number + 1]
    d0, d1 = step * c.slope_m3[number], step * c.slope_m3[number + 1]
    lean, bow = 3.0 * (v1 - v0) - 2.0 * d0 - d1, 2.0 * (v0 - v1) + d0 + d1
    volume = v0 + t * (d0 + t * (lean + t * bow))
    slope = (d0 + t * (2.0 * lean + 3.0 * t * bow)) / step
    density = m / volume
    out = valve_flow(p, density, y, c)
    push = c.port_m2 * (p - c.discharge_pa) - c.reed_stiffness * y - c.reed_damping * v
    if y < 0.0:
        push += max(-c.seat_stiffness * y - c.seat_damping * v, 0.0)
    elif y > c.stop_m:
        push -= max(c.seat_stiffness * (y - c.stop_m) + c.seat_damping * v, 0.0)
    fastest = 2.0 * np.sqrt(c.seat_stiffness / c.reed_kg)
    distance = min(abs(y), abs(y - c.stop_m))
    if abs(v) > RESTING_M_PER_S and distance < MEETING * c.stop_m:
        fastest *= FINER
    if not closed:
        return 0.0, 0.0, v, push / c.reed_kg, fastest
    gap = (1.0 - t) * c.gap_m2[number] + t * c.gap_m2[number + 1]
    leak = gap * nozzle_flow(p, c.suction_pa, density, c.suction_density, c.kappa)
    state = p / density if out > 0.0 else c.discharge_pa / c.discharge_density
    change = -p * slope * c.angular_speed - p / density * leak - state * out
    near = max(abs(p - c.discharge_pa), SMALLEST_DIFFERENCE * c.discharge_pa)
    fastest += c.kappa * state * abs(out) / near / volume
    return c.kappa * change / volume, -leak - out, v, push / c.reed_kg, fastest


@numba.njit(cache=True, nogil=True, error_model="numpy")
def advance(state: Array, start: float, end: float, closed: bool, c: Chamber) -> None:
    """Carry a state from one angle to another in steps that the fastest rate sets; it is changed.

    Parameters
    ----------
    state : shape (4,)
    start, end : rad
    closed : whether the suction port is passed
    c : constants
    """
    p, m, y, v = state[0], state[1], state[2], state[3]
    angle = start
    while angle < end:
        a0, a1, a2, a3, fastest = rates(angle, p, m, y, v, closed, c)
        duration = (end - angle) / c.angular_speed
        count = min(max(np.ceil(duration * fastest / REACH), 1.0), float(MOST_STEPS))
        h = duration / count
        to = end if count == 1.0 else angle + h * c.angular_speed
        half, mid = 0.5 * h, 0.5 * (angle + to)
        b0, b1, b2, b3, _ = rates(mid, p + half * a0, m + half * a1, y + half * a2,
                                  v + half * a3, closed, c)  # fmt: skip
        d0, d1, d2, d3, _ = rates(mid, p + half * b0, m + half * b1, y + half * b2,
                                  v + half * b3, closed, c)  # fmt: skip
        e0, e1, e2, e3, _ = rates(to, p + h * d0, m + h * d1, y + h * d2, v + h * d3, closed, c)
        p += increment(h, a0, b0, d0, e0)
        m += increment(h, a1, b1, d1, e1)
        y += increment(h, a2, b2, d2, e2)
        v += increment(h, a3, b3, d3, e3)
        angle = to
    state[0], state[1], state[2], state[3] = p, m, y, v


@numba.njit(cache=True, nogil=True, error_model="numpy")
def chamber_turn(lift: float, speed: float, c: Chamber) -> Array:
    """States over a turn of a chamber that starts at suction pressure, shape (4, steps + 1).

    Parameters
    ----------
    lift, speed : lift and speed of the reed at the start, m and m/s
    c : constants
    """
    states = np.empty((4, c.steps + 1))
    state = np.array([c.suction_pa, c.suction_density * c.volume_m3[0], lift, speed])
    states[:, 0] = state
    step = 2.0 * np.pi / c.steps
    for number in range(c.steps):
        start, end = step * number, step * (number + 1)
        split = min(max(c.closes_at, start), end)
        advance(state, start, split, False, c)
        if split > start:
            t = split / step - number
            volume = (1.0 - t) * c.volume_m3[number] + t * c.volume_m3[number + 1]
            state[1] = c.suction_density * volume
        advance(state, split, end, True, c)
        states[:, number + 1] = state
    return states


@numba.njit(cache=True, nogil=True, error_model="numpy")
def discharge_flow(states: Array, c: Chamber) -> Array:
    """Flow through the valve at the states of a turn, kg/s, shape (steps + 1,)."""
    flow = np.empty(c.steps + 1)
    for number in range(c.steps + 1):
        density = states[1, number] / c.volume_m3[number]
        flow[number] = valve_flow(states[0, number], density, states[2, number], c)
    return flow
