"""Loads of main and sub bearing: what the shaft hands on to the housing at two heights."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.moving_parts import MovingPart, circling, wrenches_of_parts
from ..oldham_scroll.revolution import counterweight
from .cycle import RollingPistonCycle, counterweight_moments
from .parameters import RollingPistonTables


def turning_parts(machine: RollingPistonTables, crank_angle: Array) -> list[MovingPart]:
    """Eccentrics, rollers as masses on their centres, and counterweights on their circles.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    crank_angle : shape (samples,), rad
    """
    radius, roller = machine.cylinder.eccentricity_m, machine.roller
    parts = [
        circling(name, mass, radius, height, crank_angle + lead)
        for lead, height in machine.cylinder.stations
        for name, mass in (("eccentric", roller.eccentric_mass_kg), ("roller", roller.mass_kg))
    ]
    planes = machine.counterweights
    ends = {"upper_counterweight": planes.upper_height_m,
            "lower_counterweight": planes.lower_height_m}  # fmt: skip
    for (name, height), moment in zip(ends.items(), counterweight_moments(machine), strict=True):
        parts.append(counterweight(name, moment, planes.radius_m, height, crank_angle))
    return parts


def bearing_forces_n(machine: RollingPistonTables, cycle: RollingPistonCycle) -> Array:
    """Forces of the shaft on main and sub bearing, along and across the vane.

    Gas and vane on the rollers less the inertia of all that circles, by the lever of two supports;
    the rotor is balanced about its axis and the shaft rigid.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    cycle : cycle of the machine

    Returns
    -------
    shape (2, 2, samples), N: bearing, axis, crank angle
    """
    turning = wrenches_of_parts(turning_parts(machine, cycle.rotation.crank_angle), cycle.rotation)
    force = sum(wrench.force_n[:2] for wrench in turning.values())
    # a force f at height z has the moment (-z f_y, z f_x)
    lever = sum(np.stack([each.moment_n_m[1], -each.moment_n_m[0]]) for each in turning.values())
    for number, (_, height) in enumerate(machine.cylinder.stations):
        on_roller = cycle.over_shaft(cycle.contacts[number].on_roller_n, number)
        force, lever = force + on_roller, lever + height * on_roller
    main, sub = (
        machine.rotary_shaft.main_bearing_height_m,
        machine.rotary_shaft.sub_bearing_height_m,
    )
    on_main = (lever - sub * force) / (main - sub)
    return np.stack([on_main, force - on_main])
