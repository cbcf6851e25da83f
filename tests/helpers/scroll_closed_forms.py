"""Displacement, built-in ratio and pressure, work of a revolution: the scroll in closed form."""

from types import SimpleNamespace

import numpy as np

from vibroacoustics.sources.scroll_gas.parameters import (
    ScrollGas,
    ScrollWraps,
    contact_angle,
    pocket_volume,
    swept_volume_m3,
)
from vibroacoustics.sources.scroll_gas.suction import volume_and_swelling


def displacement_m3(wraps: ScrollWraps) -> float:
    """Volume drawn in per revolution: both outer pockets when they close."""
    return 2.0 * float(pocket_volume(wraps, np.zeros(())))


def built_in_volume_ratio(wraps: ScrollWraps) -> float:
    """Volume of a pocket when it closes over that when it opens."""
    closed, opened = pocket_volume(wraps, np.array([0.0, wraps.opening_angle_rad]))
    return float(closed / opened)


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


def suction_volume_m3(wraps: ScrollWraps, since_closing):
    """Volume of one suction pocket at crank angles since the one before has closed, m³."""
    outer = float(contact_angle(wraps, np.zeros(())))
    constants = SimpleNamespace(outer_contact=outer, swept_volume=swept_volume_m3(wraps))
    return volume_and_swelling.py_func(np.asarray(since_closing), constants)[0]
