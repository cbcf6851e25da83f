"""Slider-link mechanism: pressure in the cylinder and the gas force."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.cylinder import CylinderGas
from ...mechanics.cylinder_gas import IdealValveCycle
from ...mechanics.valve_flows import ValvedCylinder
from .parameters import SliderLink


def cylinder_pressure(gas: CylinderGas, angle: Array) -> Array:
    """Pressure in the cylinder, Pa: polytropic, ideal valves.

    Stands in for the valve model of the paper's reference [1], which it does not print.

    Parameters
    ----------
    gas : pressures in Pa
    angle : crank angle, rad
    """
    fill = gas.clearance_ratio + 0.5 * (1.0 - np.cos(angle))
    return _cycle(gas).pressure_pa(fill, np.sin(angle) > 0.0)


def valve_angles(gas: CylinderGas) -> tuple[float, float]:
    """Crank angles where suction and discharge begin, rad.

    Parameters
    ----------
    gas : pressures in Pa
    """
    cycle, clearance = _cycle(gas), gas.clearance_ratio
    suction = np.arccos(1.0 - 2.0 * (cycle.fill_at_suction - clearance))
    discharge = np.arccos(1.0 - 2.0 * (cycle.fill_at_discharge - clearance))
    return float(suction), float(2.0 * np.pi - discharge)


def valved_cylinder(mechanism: SliderLink, gas: CylinderGas) -> ValvedCylinder:
    """The cylinder as sources of sound take it: the piston moves by a pure cosine."""
    displaced = 0.5 * np.pi * mechanism.bore_m**2 * mechanism.crank_radius_m
    return ValvedCylinder(
        displaced, _cycle(gas), lambda angle: gas.clearance_ratio + 0.5 * (1.0 - np.cos(angle))
    )


def gas_force(mechanism: SliderLink, gas: CylinderGas, angle: Array) -> Array:
    """Gas force (1) = (p_c - p_0) A_p, N, on the piston towards -x.

    Parameters
    ----------
    mechanism : lengths in m
    gas : pressures in Pa
    angle : crank angle, rad
    """
    area = np.pi / 4.0 * mechanism.bore_m**2
    return np.asarray((cylinder_pressure(gas, angle) - gas.suction_pressure_pa) * area)


def _cycle(gas: CylinderGas) -> IdealValveCycle:
    return IdealValveCycle(
        gas.suction_pressure_pa,
        gas.discharge_pressure_pa,
        gas.exponent_ratio,
        gas.clearance_ratio,
    )
