"""The Oldham ring: a mass that slides to and fro once per revolution."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.moving_parts import MovingPart, path
from .parameters import OldhamScrollTables


def oldham_ring(machine: OldhamScrollTables, crank_angle: Array) -> tuple[MovingPart, ...]:
    """Oldham ring on its slots in the housing (thesis eq. 7.3): x = r cos θ.

    The stroke amplitude r is the orbit radius. The inertia force is m ω² r once per revolution,
    not twice as the thesis's abstract says.

    Parameters
    ----------
    machine : masses in kg, places in m
    crank_angle : shape (samples,), rad
    """
    stroke = machine.kinematics.orbit_radius_m * np.cos(crank_angle)
    ring = machine.oldham
    return (MovingPart("oldham", ring.mass_kg, path(stroke, 0.0, ring.height_m)),)
