"""Pressure in the pockets over crank angle, and the gas of a turn."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from .chambers import pocket_volume
from .parameters import ScrollGas, ScrollWraps
from .suction import SuctionFlow


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
