"""Pressure in the pockets over crank angle."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from .parameters import ScrollGas, ScrollWraps
from .pockets import pocket_volume

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
