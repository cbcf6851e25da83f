"""Curves of the rolling-piston compressor over the crank angle."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from .cycle import RollingPistonCycle, bearing_forces_n
from .geometry import compression_volume, suction_volume
from .parameters import RollingPistonTables
from .revolution import cycle_for

AXES: Final = CurveAxis("axis", ["along the vane", "across"])
PARK: Final = "Park 2010, closed form of the volumes"


def rolling_piston_curves(machine: RollingPistonTables, speed_rpm: float) -> Iterator[Curve]:
    """Volumes, pressure, valve, torques, speed, vane, roller and bearing forces.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    """
    cycle = cycle_for(machine, speed_rpm, CRANK_ANGLES)
    yield from _gas(machine, cycle)
    yield from _torques(cycle)
    yield from _vane(machine, cycle)
    yield Curve(
        "bearing_force", "Forces of the shaft on main and sub bearing",
        bearing_forces_n(machine, cycle),
        (CurveAxis("bearing", ["main bearing", "sub bearing"]), AXES, _angle(cycle)), "n",
        "gas, vane and inertia by the lever of two supports",
    )  # fmt: skip


def _angle(cycle: RollingPistonCycle) -> CurveAxis:
    return angle_axis(cycle.rotation.crank_angle)


def _gas(machine: RollingPistonTables, cycle: RollingPistonCycle) -> Iterator[Curve]:
    angle, gas = cycle.rotation.crank_angle, cycle.gas
    volumes = [suction_volume(machine.cylinder, angle)[0],
               compression_volume(machine.cylinder, angle)[0]]  # fmt: skip
    yield Curve(
        "chamber_volume", "Volumes of suction and compression chamber", np.array(volumes),
        (CurveAxis("chamber", ["suction", "compression"]), _angle(cycle)), "cm3", PARK,
    )  # fmt: skip
    yield Curve(
        "compression_pressure", "Pressure in the compression chamber", gas.compression_pa,
        (_angle(cycle),), "bar", "ideal gas with reed valve and leakage",
    )  # fmt: skip
    yield Curve(
        "reed_lift", "Lift of the discharge reed", gas.lift_m, (_angle(cycle),), "mm",
        "one mass on a spring between seat and stop",
    )  # fmt: skip


def _torques(cycle: RollingPistonCycle) -> Iterator[Curve]:
    motor = cycle.rotation.motor_torque_n_m
    lines = np.array([cycle.load_n_m, motor, motor - cycle.load_n_m])
    names = ["load", "motor", "residual"]
    yield Curve(
        "shaft_torque", "Torque of load and motor on the shaft", lines,
        (CurveAxis("torque_of", names), _angle(cycle)), "n_m",
        "gas on roller and vane, friction; motor as the drive sets it",
    )  # fmt: skip
    yield Curve(
        "shaft_speed", "Speed of the shaft", cycle.rotation.speed_rad_per_s, (_angle(cycle),),
        "rad_per_s", "derived from the residual torque and the inertia of all that turns",
    )  # fmt: skip


def _vane(machine: RollingPistonTables, cycle: RollingPistonCycle) -> Iterator[Curve]:
    contact = cycle.contacts[0]
    yield Curve(
        "vane_extension", "Extension of the vane into the bore", contact.extension[0],
        (_angle(cycle),), "mm", "Park 2010, vane",
    )  # fmt: skip
    forces = np.array([contact.tip_n, contact.slot_n[0], contact.slot_n[1]])
    yield Curve(
        "vane_force", "Forces on the vane of the first cylinder", forces,
        (CurveAxis("vane_contact", ["tip", "mouth of the slot", "rear end"]), _angle(cycle)), "n",
        "gas, spring, inertia and friction of the vane",
    )  # fmt: skip
    yield Curve(
        "roller_spin", "Spin of the roller of the first cylinder", contact.spin_rad_per_s,
        (_angle(cycle),), "rad_per_s", "oil films and friction of the vane's tip",
    )  # fmt: skip
