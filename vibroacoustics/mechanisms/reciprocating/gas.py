"""Gas in the cylinder of a reciprocating compressor with ideal valves."""

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from ...mechanics.cylinder_gas import IdealValveCycle
from .machine import CylinderGas


def cylinder_pressure(swept_m3: Array, expanding: NDArray[np.bool_], gas: CylinderGas) -> Array:
    """Pressure over a revolution: polytropic with index n, valves that open without loss, Pa.

    Tsuji et al. 2012, 3.1. After top dead centre the gas in the clearance expands down to suction
    pressure, after bottom dead centre the charge is compressed up to discharge pressure.

    Parameters
    ----------
    swept_m3 : volume that the piston has uncovered since top dead centre, shape (samples,), m³
    expanding : whether the piston moves towards the crankshaft, shape (samples,)
    gas : pressures, polytropic index, clearance
    """
    cycle = IdealValveCycle(
        gas.suction_pressure_pa,
        gas.discharge_pressure_pa,
        gas.polytropic_index,
        gas.clearance_ratio,
    )
    fill = swept_m3 / float(np.max(swept_m3)) + gas.clearance_ratio
    return cycle.pressure_pa(fill, expanding)


def compression_work_j(displaced_m3: float, gas: CylinderGas) -> float:
    """Indicated work of a revolution in closed form, ∮ V dp of two polytropes, J.

    W = n/(n-1) p_s V_i [(p_d/p_s)^((n-1)/n) - 1] with the volume V_i drawn in, which is the
    displaced one less the expansion of the clearance.
    """
    n, ratio = gas.polytropic_index, gas.discharge_pressure_pa / gas.suction_pressure_pa
    drawn_in = displaced_m3 * (1.0 + gas.clearance_ratio * (1.0 - ratio ** (1.0 / n)))
    rise = ratio ** ((n - 1.0) / n) - 1.0
    return float(n / (n - 1.0) * gas.suction_pressure_pa * drawn_in * rise)
