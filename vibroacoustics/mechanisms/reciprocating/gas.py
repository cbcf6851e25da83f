"""Gas in the cylinder of a reciprocating compressor with ideal valves."""

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from ...mechanics.cylinder_gas import IdealValveCycle
from .parameters import CylinderGas


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
