"""Slider-link mechanism: pressure in the cylinder and the gas force."""

import numpy as np

from ...moving_parts import Array
from ...parameters.slider_link import CylinderGas, SliderLink


def cylinder_pressure(mechanism: SliderLink, gas: CylinderGas, angle: Array) -> Array:
    """Pressure in the cylinder, Pa: polytropic, ideal valves.

    Stands in for the valve model of the paper's reference [1], which it does not print.

    Parameters
    ----------
    mechanism : lengths in m
    gas : pressures in Pa
    angle : crank angle, rad
    """
    turn = np.mod(angle, 2.0 * np.pi)
    fill = gas.clearance_ratio + 0.5 * (1.0 - np.cos(turn))  # volume per displacement
    full = 1.0 + gas.clearance_ratio
    expansion = gas.discharge_pressure_pa * (gas.clearance_ratio / fill) ** gas.exponent_ratio
    compression = gas.suction_pressure_pa * (full / fill) ** gas.exponent_ratio
    return np.where(
        turn < np.pi,
        np.maximum(expansion, gas.suction_pressure_pa),
        np.minimum(compression, gas.discharge_pressure_pa),
    )


def valve_angles(gas: CylinderGas) -> tuple[float, float]:
    """Crank angles where suction and discharge begin, rad.

    Parameters
    ----------
    gas : pressures in Pa
    """
    ratio = (gas.discharge_pressure_pa / gas.suction_pressure_pa) ** (1.0 / gas.exponent_ratio)
    clearance = gas.clearance_ratio
    suction = np.arccos(1.0 - 2.0 * clearance * (ratio - 1.0))
    discharge = np.arccos(1.0 - 2.0 * ((1.0 + clearance) / ratio - clearance))
    return float(suction), float(2.0 * np.pi - discharge)


def gas_force(mechanism: SliderLink, gas: CylinderGas, angle: Array) -> Array:
    """Gas force (1) = (p_c - p_0) A_p, N, on the piston towards -x.

    Parameters
    ----------
    mechanism : lengths in m
    gas : pressures in Pa
    angle : crank angle, rad
    """
    area = np.pi / 4.0 * mechanism.bore_m**2
    return np.asarray((cylinder_pressure(mechanism, gas, angle) - gas.suction_pressure_pa) * area)
