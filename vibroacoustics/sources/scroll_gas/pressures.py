"""Pressure in the pockets over crank angle, and the work of a revolution in closed form."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from .parameters import ScrollGas, ScrollWraps
from .pockets import built_in_volume_ratio, displacement_m3, pocket_volume

OPENED_BEFORE: Final = 1e-9
"""Crank angle before the opening at which a pocket counts as open, rad: rounding must not decide
on which side of the step a sample lies that falls on it."""


def pocket_pressure(wraps: ScrollWraps, gas: ScrollGas, angle_since_closing: Array) -> Array:
    """Pressure in a pocket: suction, polytropic from its closing, discharge from its opening, Pa.

    p = p_s (V_s/V)^n (thesis 6.1, Appendix A). When the pocket opens, its pressure becomes that of
    the discharge, from above (over-compression) or from below (under-compression), along half a
    cosine over the equalisation angle: the gap grows from nothing.

    Parameters
    ----------
    wraps : geometry
    gas : pressures and polytropic index
    angle_since_closing : crank angle since the pocket has closed, any shape, rad; negative before
    """
    opening = wraps.opening_angle_rad
    volume = pocket_volume(wraps, np.clip(angle_since_closing, 0.0, opening))
    ratio = pocket_volume(wraps, np.zeros(())) / volume
    compressed = gas.suction_pressure_pa * ratio**gas.polytropic_index
    since_opening = np.maximum(angle_since_closing - opening + OPENED_BEFORE, 0.0)
    width = max(gas.equalisation_angle_rad, OPENED_BEFORE)
    left = 0.5 + 0.5 * np.cos(np.pi * np.minimum(since_opening / width, 1.0))
    return np.asarray(gas.discharge_pressure_pa + left * (compressed - gas.discharge_pressure_pa))


def built_in_pressure_pa(wraps: ScrollWraps, gas: ScrollGas) -> float:
    """Pressure in a pocket just before it opens."""
    return float(gas.suction_pressure_pa * built_in_volume_ratio(wraps) ** gas.polytropic_index)


def compression_work_j(wraps: ScrollWraps, gas: ScrollGas) -> float:
    """Work on the gas per revolution in closed form, ∮ V dp of polytrope and step at once, J.

    W = n/(n-1) p_s V_s (ε^(n-1) - 1) + (p_d - p_i) V_s/ε with the built-in volume ratio ε and the
    built-in pressure p_i = p_s ε^n. The least work of n/(n-1) p_s V_s ((p_d/p_s)^((n-1)/n) - 1)
    is reached where p_i = p_d.
    """
    n, ratio, drawn_in = gas.polytropic_index, built_in_volume_ratio(wraps), displacement_m3(wraps)
    compressed = n / (n - 1.0) * gas.suction_pressure_pa * drawn_in * (ratio ** (n - 1.0) - 1.0)
    step = gas.discharge_pressure_pa - built_in_pressure_pa(wraps, gas)
    return float(compressed + step * drawn_in / ratio)
