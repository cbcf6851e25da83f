"""Damping between the Oldham ring and the frame (thesis 7.4)."""

import numpy as np

from ..moving_parts import Array, Balancing
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import RingDamping
from ..units import shaft_frequency_hz


def ring_damping(
    option: RingDamping, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Viscous damping of the ring against the frame.

    The damping force is an internal pair and the crank prescribes the ring's motion: no momentum
    changes, so no force on the housing does. It costs the power c (ω r)² / 2.
    """
    velocity = 2.0 * np.pi * shaft_frequency_hz(speed_rpm) * machine.kinematics.orbit_radius_m
    power = 0.5 * option.damping_ns_per_m * velocity**2
    return Balancing(facts={"added_mass_kg": 0.0, "dissipated_power_w": power})
