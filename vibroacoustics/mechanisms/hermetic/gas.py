"""Gas force over the crank angle: polytropic compression and re-expansion, ideal valves."""

import numpy as np
from scipy.optimize import brentq

from ...moving_parts import Array
from ...parameters.hermetic import HermeticCompressor


def piston_area_m2(machine: HermeticCompressor) -> float:
    """Area of the piston's face."""
    return 0.25 * np.pi * machine.piston.diameter_m**2


def volume_ratio(machine: HermeticCompressor, crank_angle: Array) -> Array:
    """Cylinder volume over clearance volume; top dead centre is θ = 0 by Estupiñan eq. 1."""
    radius, length = machine.crank.radius_m, machine.rod.length_m
    place = radius * np.cos(crank_angle) + np.sqrt(length**2 - (radius * np.sin(crank_angle)) ** 2)
    lift = (radius + length - place) / (2.0 * radius)
    return np.asarray(1.0 + lift / machine.gas.clearance_ratio)


def gas_force_n(machine: HermeticCompressor, crank_angle: Array) -> Array:
    """Force of the gas on the piston above the suction pressure in the shell, N.

    The paper takes the curve of Cho & Moon (2005), which it prints as a figure only.

    Parameters
    ----------
    machine : pressures in Pa, polytropic exponent
    crank_angle : θ, rad; the gas expands for 0 < θ < π
    """
    gas = machine.gas
    ratio, exponent = volume_ratio(machine, crank_angle), gas.exponent_ratio
    fullest = 1.0 + 1.0 / gas.clearance_ratio
    expanding = np.maximum(gas.discharge_pressure_pa * ratio**-exponent, gas.suction_pressure_pa)
    compressed = gas.suction_pressure_pa * (fullest / ratio) ** exponent
    compressing = np.minimum(compressed, gas.discharge_pressure_pa)
    pressure = np.where(np.sin(crank_angle) > 0.0, expanding, compressing)
    return np.asarray((pressure - gas.suction_pressure_pa) * piston_area_m2(machine))


def valve_angles(machine: HermeticCompressor) -> tuple[float, float]:
    """Crank angles at which the suction and the discharge valve open, rad: kinks of the force."""
    gas = machine.gas
    expansion = (gas.discharge_pressure_pa / gas.suction_pressure_pa) ** (1.0 / gas.exponent_ratio)
    fullest = 1.0 + 1.0 / gas.clearance_ratio
    suction = _angle_of(machine, expansion)
    return suction, 2.0 * np.pi - _angle_of(machine, fullest / expansion)


def _angle_of(machine: HermeticCompressor, ratio: float) -> float:
    """Crank angle of the outward stroke at a volume ratio."""
    return float(
        brentq(lambda angle: volume_ratio(machine, np.array(angle)) - ratio, 0.0, np.pi, xtol=1e-14)
    )
