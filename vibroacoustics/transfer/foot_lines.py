"""Forces of the feet on the floor at the lines of all sources."""

from collections.abc import Mapping

import numpy as np

from ..base.arrays import ComplexArray
from ..machine.source import Case
from ..mechanics.loads import Loads, PortLoads, lines_of, summed
from .foot_figures import foot_force
from .machine import on_mounts


def force_at_lines(
    case: Case,
    loads: Mapping[str, Loads],
    wrenches: Mapping[str, PortLoads],
    names: list[str],
) -> ComplexArray:
    """Compute the force of each foot on the floor at the lines, all sources, (line, foot, axis), N.

    Parameters
    ----------
    case : speed and option
    loads : of all sources in it
    wrenches : lines of the wrenches over crank angle by source
    names : of the lines
    """
    orders = sum(name.startswith("order ") for name in names)
    lines = lines_of(loads, case.shaft_frequency_hz, orders - 1, wrenches)
    known = foot_force(on_mounts(case.machine), summed(lines.loads.values()), lines.frequency_hz)
    force = np.zeros((len(names), *known.shape[1:]), dtype=complex)
    force[[names.index(name) for name in lines.names]] = known
    return force
