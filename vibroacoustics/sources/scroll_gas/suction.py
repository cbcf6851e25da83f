"""The filling of suction pockets over a turn, and the pressure in all pockets."""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...base.units import shaft_frequency_hz
from ...mechanics.runge_kutta import increment
from .opening_equations import density, flow_rise, pressure_rise
from .parameters import ScrollGas, ScrollWraps, contact_angle, pocket_volume, swept_volume_m3

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


@dataclass(frozen=True)
class TrappedGas:
    """Gas of a pair of closed pockets, and what crosses its outer contacts.

    Attributes
    ----------
    since_closing : crank angle, from 0 to the opening, shape (steps,), rad
    mass_ratio : shape (steps,): mass over that which the pair would hold from constant suction
        pressure without leakage
    contact_angle : shape (contact steps,): crank angle since the closing of the outer contacts,
        from 0 to a turn after the opening, when they open too, rad
    leak_kg_per_s : flow outwards across both of them, shape of `contact_angle`
    """

    since_closing: Array
    mass_ratio: Array
    contact_angle: Array
    leak_kg_per_s: Array


@dataclass(frozen=True)
class OpenedGas:
    """Gas at the discharge over a turn from the opening of a pair of pockets, shape (steps + 1,)
    each.

    Attributes
    ----------
    since_opening : crank angle, 0 to 2π, shape (steps + 1,), rad
    pair_pa : pressure in the opened pair; after half a turn that of the chamber
    chamber_pa : in the chamber inside all closed pockets, out of which the port leads
    plenum_pa : beyond the port
    gap_flow_kg_per_s : from pair to chamber; zero after half a turn
    port_flow_kg_per_s : from chamber to plenum
    trapped : gas of the closed pockets where they leak or fill with inertia; else none
    filling : filling of the suction pockets where their pressure acts; else none
    """

    since_opening: Array
    pair_pa: Array
    chamber_pa: Array
    plenum_pa: Array
    gap_flow_kg_per_s: Array
    port_flow_kg_per_s: Array
    trapped: TrappedGas | None = None
    filling: SuctionFlow | None = None


OPENED_BEFORE: Final = 1e-9
"""Crank angle before the opening at which a pocket counts as open, rad: rounding must not decide
on which side of the step a sample lies that falls on it."""


def pocket_pressure(
    wraps: ScrollWraps, gas: ScrollGas, angle_since_closing: Array, opened: OpenedGas | None = None
) -> Array:
    """Pressure in a pocket: suction, polytropic from its closing, discharge from its opening, Pa.

    p = p_s (V_s/V)^n (thesis 6.1, Appendix A) until the pocket opens. Then, without `opened`, its
    pressure becomes that of the discharge, from above (over-compression) or from below
    (under-compression), along half a cosine over the equalisation angle: the gap grows from
    nothing. With it, it is that of the opened pair for a turn, of the chamber inside from then on,
    and before, where these are given, that of trapped gas that leaks and of a pocket that fills.

    Parameters
    ----------
    wraps : geometry
    gas : pressures and polytropic index
    angle_since_closing : crank angle since the pocket has closed, any shape, rad; negative before
    opened : gas after the opening, of the law `inertia`
    """
    since_opening = angle_since_closing - wraps.opening_angle_rad + OPENED_BEFORE
    compressed = polytropic_pressure_pa(wraps, gas, angle_since_closing)
    if opened is None:
        return _over_equalisation_angle(gas, compressed, np.maximum(since_opening, 0.0))
    compressed = _before_opening(gas, angle_since_closing, compressed, opened)
    in_turn = np.mod(since_opening, 2.0 * np.pi)
    pair, chamber = (
        np.interp(in_turn, opened.since_opening, pressure)
        for pressure in (opened.pair_pa, opened.chamber_pa)
    )
    after = np.where(since_opening < 2.0 * np.pi, pair, chamber)
    return np.asarray(np.where(since_opening < 0.0, compressed, after))


def built_in_pressure_pa(wraps: ScrollWraps, gas: ScrollGas) -> float:
    """Pressure in a pocket just before it opens, Pa."""
    return float(polytropic_pressure_pa(wraps, gas, np.asarray(wraps.opening_angle_rad)))


def _before_opening(
    gas: ScrollGas, angle_since_closing: Array, compressed: Array, opened: OpenedGas
) -> Array:
    """Pressure in closed pockets that leak, in suction pockets that fill, Pa."""
    trapped, filling = opened.trapped, opened.filling
    if trapped is not None:
        ratio = np.interp(angle_since_closing, trapped.since_closing, trapped.mass_ratio)
        closed = angle_since_closing >= 0.0
        compressed = np.where(closed, compressed * ratio**gas.polytropic_index, compressed)
    if filling is not None:
        compressed = filling.pocket_pressure_pa(angle_since_closing, compressed)
    return compressed


def polytropic_pressure_pa(wraps: ScrollWraps, gas: ScrollGas, angle_since_closing: Array) -> Array:
    """Pressure of a pocket that neither leaks nor fills with inertia, constant after the opening,
    Pa."""
    volume = pocket_volume(wraps, np.clip(angle_since_closing, 0.0, wraps.opening_angle_rad))
    ratio = pocket_volume(wraps, np.zeros(())) / volume
    return np.asarray(gas.suction_pressure_pa * ratio**gas.polytropic_index)


def _over_equalisation_angle(gas: ScrollGas, compressed: Array, since_opening: Array) -> Array:
    width = max(gas.equalisation_angle_rad, OPENED_BEFORE)
    remaining = 0.5 + 0.5 * np.cos(np.pi * np.minimum(since_opening / width, 1.0))
    return np.asarray(
        gas.discharge_pressure_pa + remaining * (compressed - gas.discharge_pressure_pa)
    )
