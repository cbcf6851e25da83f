"""Forces of the feet on the floor at the lines of all sources."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..machine.source import Case
from ..mechanics.loads import Loads, lines_of
from .machine import on_mounts


def foot_force(
    case: Case, loads: Mapping[str, Loads], of_wrenches: xr.DataArray, names: list[str]
) -> ComplexArray:
    """Compute the force of each foot on the floor at the lines, all sources, (line, foot, axis), N.

    Parameters
    ----------
    case : speed and option
    loads : of all sources in it
    of_wrenches : forces by the wrenches over crank angle, (source, foot, axis, order)
    names : of the lines
    """
    orders = sum(name.startswith("order ") for name in names)
    lines = lines_of(loads, case.shaft_frequency_hz, orders - 1)
    load = sum(lines.rigid.values()) + np.zeros((6, len(lines.names)), dtype=complex)
    on_shell = sum(lines.on_shell.values()) + np.zeros_like(load)
    response = on_mounts(case.machine).response(load.T, lines.frequency_hz, on_shell.T)
    known = response.foot_force.copy()
    summed = of_wrenches.sum("source").transpose("order", "foot", "axis").values
    held = min(len(summed), orders)
    known[:held] += summed[:held]
    force = np.zeros((len(names), *known.shape[1:]), dtype=complex)
    force[[names.index(name) for name in lines.names]] = known
    return force
