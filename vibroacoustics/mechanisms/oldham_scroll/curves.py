"""Curves of the scroll compressor itself: force of the ring, critical speeds of the shaft."""

from collections.abc import Iterator

import numpy as np

from ...base.curves import CRANK_ANGLES, Curve, angle_axis
from ...base.units import shaft_frequency_hz
from ...mechanics.critical_speed import scroll_shaft_rotor
from ...mechanics.rotation import uniform_crank_angle
from ...mechanics.whirl_curves import critical_speed_curves
from .parameters import OldhamScrollTables


def oldham_scroll_curves(machine: OldhamScrollTables, speed_rpm: float) -> Iterator[Curve]:
    """Inertia force of the Oldham ring; Campbell map and critical speeds where a shaft is given.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    speed_rpm : constant
    """
    angle = uniform_crank_angle(CRANK_ANGLES)
    omega = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    amplitude = machine.oldham.mass_kg * machine.kinematics.orbit_radius_m * omega**2
    yield Curve(
        "ring_force", "Inertia force of the Oldham ring along its stroke",
        amplitude * np.cos(angle), (angle_axis(angle),), "n", "thesis, (7.3) and figure 25",
    )  # fmt: skip
    if machine.shaft is not None:
        rotor = scroll_shaft_rotor(machine.shaft)
        yield from critical_speed_curves(rotor, "thesis, (6.2); beam rotor")
