"""Gas force over the crank angle: polytropic compression and re-expansion, ideal valves."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from ...base.arrays import Array
from ...mechanics.cylinder_gas import ValvedCylinder
from .parameters import HermeticTables


def piston_area_m2(machine: HermeticTables) -> float:
    """Area of the piston's face."""
    return 0.25 * np.pi * machine.piston.diameter_m**2


def dead_centres(machine: HermeticTables) -> tuple[float, float]:
    """Crank angles of top and bottom dead centre, where crank and rod are in line, rad.

    Top is θ = 0 by Estupiñan eq. 1, whose cylinder has no offset.
    """
    offset = machine.piston.cylinder_offset_m
    longest = machine.rod.length_m + machine.crank.radius_m
    shortest = machine.rod.length_m - machine.crank.radius_m
    return float(np.arcsin(offset / longest)), float(np.pi + np.arcsin(offset / shortest))


def piston_position_m(machine: HermeticTables, crank_angle: Array) -> Array:
    """x_B of a crank that turns about a fixed axis."""
    radius, offset = machine.crank.radius_m, machine.piston.cylinder_offset_m
    across = radius * np.sin(crank_angle) - offset
    return np.asarray(radius * np.cos(crank_angle) + np.sqrt(machine.rod.length_m**2 - across**2))


def fill(machine: HermeticTables, crank_angle: Array) -> Array:
    """Cylinder volume over displaced volume."""
    top, bottom = piston_position_m(machine, np.array(dead_centres(machine)))
    lift = (top - piston_position_m(machine, crank_angle)) / (top - bottom)
    return np.asarray(machine.gas.clearance_ratio + lift)


def gas_force_n(machine: HermeticTables, crank_angle: Array) -> Array:
    """Force of the gas on the piston above the suction pressure in the shell, N.

    The paper takes the curve of Cho & Moon (2005), which it prints as a figure only.

    Parameters
    ----------
    machine : pressures in Pa, polytropic exponent
    crank_angle : θ, shape (...), rad
    """
    pressure = machine.gas.valve_cycle.pressure_pa(
        fill(machine, crank_angle), _outwards(machine, crank_angle)
    )
    return np.asarray((pressure - machine.gas.suction_pressure_pa) * piston_area_m2(machine))


def valved_cylinder(machine: HermeticTables) -> ValvedCylinder:
    """The cylinder as sources of sound take it: the crank turns about a fixed axis."""
    top, bottom = piston_position_m(machine, np.array(dead_centres(machine)))
    displaced = piston_area_m2(machine) * float(top - bottom)
    return ValvedCylinder(displaced, machine.gas.valve_cycle, lambda angle: fill(machine, angle))


def valve_angles(machine: HermeticTables) -> tuple[float, float]:
    """Crank angles at which the suction and the discharge valve open, rad: kinks of the force."""
    cycle = machine.gas.valve_cycle
    top, bottom = dead_centres(machine)
    return (
        _angle_of(machine, cycle.fill_at_suction, top, bottom),
        _angle_of(machine, cycle.fill_at_discharge, bottom, top + 2.0 * np.pi),
    )


def _outwards(machine: HermeticTables, crank_angle: Array) -> NDArray[np.bool_]:
    """Samples at which the piston moves away from the head."""
    top, bottom = dead_centres(machine)
    since_top = np.mod(crank_angle - top, 2.0 * np.pi)
    return np.asarray((since_top > 0.0) & (since_top < bottom - top))


def _angle_of(machine: HermeticTables, reached: float, first: float, last: float) -> float:
    """Crank angle of a stroke at a volume over displaced volume."""
    return float(
        brentq(lambda angle: fill(machine, np.array(angle)) - reached, first, last, xtol=1e-14)
    )
