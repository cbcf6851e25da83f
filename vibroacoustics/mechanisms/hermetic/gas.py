"""Gas force over the crank angle: polytropic compression and re-expansion, ideal valves."""

import numpy as np
from scipy.optimize import brentq

from ...moving_parts import Array
from ...parameters.hermetic import HermeticCompressor
from ..cylinder_gas import IdealValveCycle


def piston_area_m2(machine: HermeticCompressor) -> float:
    """Area of the piston's face."""
    return 0.25 * np.pi * machine.piston.diameter_m**2


def fill(machine: HermeticCompressor, crank_angle: Array) -> Array:
    """Cylinder volume over displaced volume; top dead centre is θ = 0 by Estupiñan eq. 1."""
    radius, length = machine.crank.radius_m, machine.rod.length_m
    place = radius * np.cos(crank_angle) + np.sqrt(length**2 - (radius * np.sin(crank_angle)) ** 2)
    lift = (radius + length - place) / (2.0 * radius)
    return np.asarray(machine.gas.clearance_ratio + lift)


def gas_force_n(machine: HermeticCompressor, crank_angle: Array) -> Array:
    """Force of the gas on the piston above the suction pressure in the shell, N.

    The paper takes the curve of Cho & Moon (2005), which it prints as a figure only.

    Parameters
    ----------
    machine : pressures in Pa, polytropic exponent
    crank_angle : θ, rad; the gas expands for 0 < θ < π
    """
    pressure = _cycle(machine).pressure_pa(fill(machine, crank_angle), np.sin(crank_angle) > 0.0)
    return np.asarray((pressure - machine.gas.suction_pressure_pa) * piston_area_m2(machine))


def valve_angles(machine: HermeticCompressor) -> tuple[float, float]:
    """Crank angles at which the suction and the discharge valve open, rad: kinks of the force."""
    cycle = _cycle(machine)
    suction = _angle_of(machine, cycle.fill_at_suction)
    return suction, 2.0 * np.pi - _angle_of(machine, cycle.fill_at_discharge)


def _cycle(machine: HermeticCompressor) -> IdealValveCycle:
    gas = machine.gas
    return IdealValveCycle(
        gas.suction_pressure_pa,
        gas.discharge_pressure_pa,
        gas.exponent_ratio,
        gas.clearance_ratio,
    )


def _angle_of(machine: HermeticCompressor, reached: float) -> float:
    """Crank angle of the outward stroke at a volume over displaced volume."""
    return float(
        brentq(lambda angle: fill(machine, np.array(angle)) - reached, 0.0, np.pi, xtol=1e-14)
    )
