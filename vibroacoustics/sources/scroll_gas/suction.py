"""The filling of a pair of suction pockets over a turn, with a flow that has inertia.

A pocket begins when the one before it closes: its contact runs inwards from the wrap's end, and
what it leaves behind fills through the gap at the end, h r_o (1 - cos φ). The equations are those
of the opening; the suction pressure outside is constant.
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...base.units import shaft_frequency_hz
from ...mechanics.runge_kutta import increment
from .chambers import contact_angle, swept_volume_m3
from .opening_equations import density, flow_rise, pressure_rise
from .parameters import ScrollWraps

STEPS_PER_S: Final = 400_000.0
"""The pocket is small at first: its gas swings at some 30 kHz in the gap."""
LEAST_STEPS: Final = 8192
"""A turn; 200 000 change no flow by more than 1e-6 of the largest."""
BEGINS_AT: Final = 0.02
"""Crank angle up to which the pocket fills as if its gas had constant density, rad."""
PRESSURE, FLOW = range(2)


@dataclass(frozen=True)
class SuctionFlow:
    """Filling of a pair of pockets, shape (steps + 1,) each.

    Attributes
    ----------
    since_closing : crank angle since the pair before it has closed, 0 to 2π, shape (steps + 1,)
    pocket_pa : pressure in the pockets
    flow_kg_per_s : into both of them together
    """

    since_closing: Array
    pocket_pa: Array
    flow_kg_per_s: Array

    def over_crank_angle(self, wraps: ScrollWraps, crank_angle: Array) -> Array:
        """Flow at crank angles, shape (samples,), kg/s."""
        since_closing = np.mod(crank_angle - wraps.closing_crank_angle_rad, 2.0 * np.pi)
        return np.asarray(np.interp(since_closing, self.since_closing, self.flow_kg_per_s))

    def pocket_pressure_pa(self, angle_since_closing: Array, otherwise: Array | float) -> Array:
        """Pressure in the turn before a pocket closes, elsewhere that given, Pa.

        Parameters
        ----------
        angle_since_closing : crank angle since its closing, negative before, any shape, rad
        otherwise : pressure earlier and later
        """
        since_begin = angle_since_closing + 2.0 * np.pi
        filling = np.interp(since_begin, self.since_closing, self.pocket_pa)
        fills = (since_begin >= 0.0) & (angle_since_closing < 0.0)
        return np.asarray(np.where(fills, filling, otherwise))


class FillingConstants(NamedTuple):
    """Constants of the equations in SI units; see `OpeningConstants`."""

    angular_speed: float
    swept_volume: float
    outer_contact: float
    gap_area: float
    gap_length: float
    discharge_coefficient: float
    pressure: float
    density: float
    stiffness_exponent: float


def suction_flow(
    wraps: ScrollWraps,
    gap_length_m: float,
    discharge_coefficient: float,
    gas: tuple[float, float, float],
    speed_rpm: float,
) -> SuctionFlow:
    """Pressure and flow over a turn.

    Parameters
    ----------
    wraps : geometry
    gap_length_m : length of the gap with the gas that moves along
    discharge_coefficient : discharge coefficient of the gap
    gas : pressure, density and speed of sound outside, Pa, kg/m³, m/s
    speed_rpm : constant
    """
    pressure, rho, sound = gas
    frequency = shaft_frequency_hz(speed_rpm)
    constants = FillingConstants(
        angular_speed=2.0 * np.pi * frequency,
        swept_volume=swept_volume_m3(wraps),
        outer_contact=float(contact_angle(wraps, np.zeros(()))),
        gap_area=wraps.height_m * wraps.orbit_radius_m,
        gap_length=gap_length_m,
        discharge_coefficient=discharge_coefficient,
        pressure=pressure,
        density=rho,
        stiffness_exponent=rho * sound**2 / pressure,
    )
    steps = max(LEAST_STEPS, int(STEPS_PER_S / frequency))
    states = filling(steps, BEGINS_AT, constants)
    angle = np.linspace(BEGINS_AT, 2.0 * np.pi, steps + 1)
    before = np.linspace(0.0, BEGINS_AT, 8, endpoint=False)
    return SuctionFlow(
        np.concatenate([before, angle]),
        np.concatenate([np.full(before.size, pressure), states[PRESSURE]]),
        2.0 * np.concatenate([(before / BEGINS_AT) ** 2 * states[FLOW, 0], states[FLOW]]),
    )


@numba.njit(cache=True, nogil=True, error_model="numpy")
def volume_and_swelling(angle: float, c: FillingConstants) -> tuple[float, float]:
    """Volume of one pocket and its rate, m³ and m³/rad."""
    inner, sine, cosine = c.outer_contact - angle, np.sin(angle), np.cos(angle)
    crescent = 0.5 * (c.outer_contact**2 - inner**2) - c.outer_contact * sine - cosine + 1.0
    swelling = inner - c.outer_contact * cosine + sine
    return 0.5 * c.swept_volume * crescent, 0.5 * c.swept_volume * swelling


@numba.njit(cache=True, nogil=True, error_model="numpy")
def filling_rate(
    angle: float, pressure: float, flow: float, c: FillingConstants
) -> tuple[float, float]:
    """Change of pressure and flow per radian."""
    volume, swelling = volume_and_swelling(angle, c)
    rho = density(pressure, c)
    rise = pressure_rise(pressure, rho, volume, swelling * c.angular_speed, flow, c)
    area = c.gap_area * (1.0 - np.cos(angle))
    gained = flow_rise(
        flow, c.pressure - pressure, c.density if flow > 0.0 else rho, area, c.gap_length, c
    )
    return rise / c.angular_speed, gained / c.angular_speed


@numba.njit(cache=True, nogil=True, error_model="numpy")
def filling(steps: int, begins_at: float, c: FillingConstants) -> Array:
    """Pressure in one pocket and flow into it, by classical Runge-Kutta steps, (2, steps + 1)."""
    states = np.empty((2, steps + 1))
    step = (2.0 * np.pi - begins_at) / steps
    pressure = c.pressure
    flow = c.density * c.angular_speed * volume_and_swelling(begins_at, c)[1]
    states[0, 0], states[1, 0] = pressure, flow
    for number in range(steps):
        angle = begins_at + number * step
        p1, m1 = filling_rate(angle, pressure, flow, c)
        middle = angle + 0.5 * step
        p2, m2 = filling_rate(middle, pressure + 0.5 * step * p1, flow + 0.5 * step * m1, c)
        p3, m3 = filling_rate(middle, pressure + 0.5 * step * p2, flow + 0.5 * step * m2, c)
        p4, m4 = filling_rate(angle + step, pressure + step * p3, flow + step * m3, c)
        pressure += increment(step, p1, p2, p3, p4)
        flow += increment(step, m1, m2, m3, m4)
        states[0, number + 1], states[1, number + 1] = pressure, flow
    return states
