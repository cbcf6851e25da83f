"""The orbiting set turns against crank pin and counterweights when the machine stops."""

from typing import NamedTuple

import numpy as np

from ..base.arrays import Array


class Shift(NamedTuple):
    """Angle of the set ahead of the crank pin and its derivatives in time, rad, rad/s, rad/s²."""

    angle: Array
    rate: Array
    acceleration: Array


def brake_shift(time_s: Array, shift_rad: float, duration_s: float) -> Shift:
    """A turn from rest to rest with the least jerk, δ (10u³ - 15u⁴ + 6u⁵) with u = t/duration.

    The thesis gives neither course nor size ("a few degrees"); the course is assumed.

    Parameters
    ----------
    time_s : from switch-off, any shape
    shift_rad : δ reached at the end
    duration_s : of the turn
    """
    u = np.clip(np.asarray(time_s) / duration_s, 0.0, 1.0)
    return Shift(
        shift_rad * u**3 * (10.0 - 15.0 * u + 6.0 * u**2),
        shift_rad / duration_s * 30.0 * u**2 * (1.0 - u) ** 2,
        shift_rad / duration_s**2 * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    )


def residual_force_n(mass_moment_kg_m: float, shift_rad: float, speed_rad_per_s: float) -> float:
    """Force of balanced masses after one side has turned by δ, 2 m e sin(δ/2) ω²."""
    return float(2.0 * mass_moment_kg_m * abs(np.sin(0.5 * shift_rad)) * speed_rad_per_s**2)


def overrun_torque_n_m(
    set_inertia_kg_m2: float, shaft_inertia_kg_m2: float, shaft_drag_n_m: float
) -> float:
    """Drag on the orbiting set below which its inertia carries it ahead of a coasting shaft.

    Both coast freely: the set overtakes where T_set/J_set < T_shaft/J_shaft. Thesis 6.4 takes the
    overrun for granted, but the gas torque acts on the set itself and is far above this bound.

    Parameters
    ----------
    set_inertia_kg_m2 : m r² of the orbiting set
    shaft_inertia_kg_m2 : of shaft and rotor
    shaft_drag_n_m : torque on the shaft alone, such as bearing friction
    """
    return shaft_drag_n_m * set_inertia_kg_m2 / shaft_inertia_kg_m2
