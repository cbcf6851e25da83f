"""The scroll with mini-crank as the chain takes it: force and moment by source."""

import numpy as np

from ...mechanics.crankshaft import acceleration_of, every, planar
from ...mechanics.moving_parts import Revolution, Wrench
from ..oldham_scroll.revolution import two_plane_balance
from .cycle import (
    SAMPLES,
    MiniCrankCycle,
    crank_pin_force,
    direction,
    minicrank_pin_force,
    steady_minicrank_cycle,
    turning_force,
)
from .links import MiniCrankTables


def minicrank_revolution(machine: MiniCrankTables, speed_rpm: float, samples: int) -> Revolution:
    """Steady revolution of crankshaft, scroll and mini-cranks under gas and link errors.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    stride = -(-SAMPLES // samples)
    cycle = steady_minicrank_cycle(machine, speed_rpm, samples * stride)
    facts = _facts(cycle)
    if machine.four_bar.minicranks == 1 and not cycle.links.is_parallelogram:
        facts |= _facts_of_rocking(cycle)
    return every(stride, speed_rpm, cycle.rotation, housing_wrenches(machine, cycle), facts)


def _facts(cycle: MiniCrankCycle) -> dict[str, float]:
    rotation = cycle.rotation
    torque = np.sum(list(cycle.input_torque_n_m.values()), axis=0)
    work = 2.0 * np.pi * float(np.mean(rotation.motor_torque_n_m))
    return {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        "shaft_power_w": work / rotation.duration_s,
        "largest_input_torque_nm": float(np.max(np.abs(torque))),
        "scroll_swing_deg": float(np.rad2deg(np.ptp(cycle.motion.scroll_angle[0]))),
    }


def _facts_of_rocking(cycle: MiniCrankCycle) -> dict[str, float]:
    """Swing of a mini-crank that does not turn, and the forces that rigid pins would take."""
    arguments = (cycle.links, cycle.motion, cycle.masses, cycle.load, cycle.rotation)
    forces = {
        "minicrank_pin_force_n": minicrank_pin_force(*arguments),
        "crank_pin_force_n": crank_pin_force(*arguments),
    }
    return {
        "minicrank_swing_deg": float(np.rad2deg(np.ptp(cycle.motion.minicrank_angle[0]))),
        **{name: float(np.max(np.hypot(*force))) for name, force in forces.items()},
    }


def housing_wrenches(machine: MiniCrankTables, cycle: MiniCrankCycle) -> dict[str, Wrench]:
    """-Σ m a and -d/dt of the angular momentum, by source, in the axes of the machine."""
    in_plane = {**_crankshaft(machine, cycle), "minicrank": (0.0, _minicranks(machine, cycle))}
    return {
        name: wrench.placed(machine.plane(height)) for name, (height, wrench) in in_plane.items()
    }


def counterweight_moments(machine: MiniCrankTables) -> tuple[float, float]:
    """Mass moments m r of the counterweights in the upper and lower plane, kg m.

    Zhao et al. 2013, eq. 10, as force, and the same as couple: together they balance crank pin
    and scroll on the nominal crank. A negative one stands opposite the crank pin.
    """
    masses, planes = machine.masses, machine.counterweights
    orbiting = (masses.crank_pin_mass_kg + masses.scroll_mass_kg) * machine.four_bar.crank_m
    return two_plane_balance([orbiting], [0.0], planes.upper_height_m, planes.lower_height_m)


def _crankshaft(machine: MiniCrankTables, cycle: MiniCrankCycle) -> dict[str, tuple[float, Wrench]]:
    """Height and wrench of what turns with the crankshaft and of the scroll on it.

    The roll of the turning masses is the rotor's, whose inertia includes them.
    """
    masses, planes, rotation = cycle.masses, machine.counterweights, cycle.rotation
    radius, still = cycle.links.crank_m, np.zeros_like(rotation.speed_rad_per_s)
    rotor = -masses.rotor_inertia_kg_m2 * rotation.acceleration_rad_per_s2
    scroll = -masses.scroll_inertia_kg_m2 * acceleration_of(cycle.motion.scroll_angle, rotation)
    upper, lower = counterweight_moments(machine)
    turning = {
        "orbiting_scroll": (0.0, masses.scroll_mass_kg * radius, scroll),
        "crank_pin": (0.0, masses.crank_pin_mass_kg * radius, still),
        "upper_counterweight": (planes.upper_height_m, upper, still),
        "lower_counterweight": (planes.lower_height_m, lower, still),
        "rotor": (0.0, 0.0, rotor),
    }
    return {
        name: (height, planar(turning_force(moment, cycle.motion.crank_angle, rotation), roll))
        for name, (height, moment, roll) in turning.items()
    }


def _minicranks(machine: MiniCrankTables, cycle: MiniCrankCycle) -> Wrench:
    """All mini-cranks; the forces of three add up about the axis of the crankshaft."""
    third, masses = cycle.motion.minicrank_angle, cycle.masses
    turn = acceleration_of(third, cycle.rotation)
    inward, across = -direction(third[0]), direction(third[0] + 0.5 * np.pi)
    rate = third[1] * cycle.rotation.speed_rad_per_s
    force = -masses.minicrank_mass_kg * cycle.links.minicrank_m * (across * turn + inward * rate**2)
    roll = -masses.minicrank_inertia_kg_m2 * turn
    if machine.four_bar.minicranks == 1:
        roll = roll + cycle.links.bracket_m * force[1]
    return planar(force, roll)
