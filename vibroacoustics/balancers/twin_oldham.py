"""A twin Oldham ring in opposite phase (thesis 7.3)."""

import numpy as np

from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import TwinOldham


def twin_oldham(
    option: TwinOldham, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Second ring, 180° out of phase, at the other end of the shaft (thesis eq. 7.21).

    The force cancels; force times the distance of the two rings remains as a couple. The piece
    that drives the twin is taken as balanced on the shaft.
    """
    amplitude = option.stroke_ratio * machine.kinematics.orbit_radius_m
    height = machine.oldham.height_m - option.distance_below_ring_m
    twin = MovingPart(
        "balancer", option.mass_kg, path(-amplitude * np.cos(crank_angle), 0.0, height)
    )
    return Balancing((twin,), {"added_mass_kg": option.mass_kg})
