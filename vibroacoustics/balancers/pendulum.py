"""Pendulums hung from the Oldham ring (thesis 7.1): the driven nonlinear pendulum."""

import numpy as np

from ..errors import ParameterError
from ..mechanics.pendulum import Drive, multiplier, periodic_state, settle, swing
from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import Pendulum
from ..units import shaft_frequency_hz


def pendulum(
    option: Pendulum, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Two equal pendulums on the ring, in the periodic state that they settle in.

    Both bobs are taken on the same side, so that their vertical forces add. Their arms to either
    side of the ring are equal: one bob of the total mass in the middle makes the same force and
    moment.

    Raises
    ------
    SolverError
        No periodic state was found.
    """
    stroke = machine.kinematics.orbit_radius_m
    mass = pendulum_mass(stroke, machine.oldham.mass_kg, option.horizontal_reach_m)
    drive = Drive(option.length_m, option.damping_ratio, stroke, shaft_frequency_hz(speed_rpm))
    settled = settle(drive)
    hanging = periodic_state(drive, (-stroke / option.length_m, 0.0))
    angle = swing(drive, settled, crank_angle)
    bob = path(
        stroke * np.cos(crank_angle) + option.length_m * np.sin(angle),
        0.0,
        machine.oldham.height_m - option.length_m * np.cos(angle),
    )
    return Balancing(
        (MovingPart("balancer", mass, bob),),
        {
            "added_mass_kg": mass,
            "settled_angle_deg": float(np.rad2deg(abs(np.mean(angle)))),
            "hanging_multiplier": multiplier(drive, hanging),
            "settled_multiplier": multiplier(drive, settled),
        },
    )


def pendulum_mass(stroke_m: float, ring_mass_kg: float, horizontal_reach_m: float) -> float:
    """Total bob mass of thesis (7.5) and (7.10): m = x_b M / (l_h - x_b), kg.

    Raises
    ------
    ParameterError
        The bobs cannot swing farther out than the ring moves.
    """
    if horizontal_reach_m <= stroke_m:
        raise ParameterError(
            f"horizontal_reach_mm = {1e3 * horizontal_reach_m:g} mm: must exceed the "
            f"ring's stroke amplitude of {1e3 * stroke_m:g} mm"
        )
    return stroke_m * ring_mass_kg / (horizontal_reach_m - stroke_m)
