"""Forces of the sources where they act, as a section of the machine shows them."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..base.vocabulary import AXES, stamped
from ..machine.frame import Frame, Part
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure
from ..machine.suspension import BLOCK
from ..mechanics.loads import summed
from ..mechanics.ports import WRENCH, Port
from .deflection import MovingCase

_LINES: Final = ("order 1", "loudest")
"""Lines whose forces are shown."""


def section_variables(cases: Mapping[str, MovingCase], machine: Machine) -> xr.Dataset:
    """Label the forces of all sources together at order 1 and at the line of each case."""
    loads = {option: summed(case.lines.loads.values()) for option, case in cases.items()}
    every = dict.fromkeys(port for by_port in loads.values() for port in by_port)
    ports = [port for port in every if port.components == WRENCH]
    force: ComplexArray = np.zeros((len(cases), 2, len(ports), 3), dtype=complex)
    for row, (option, case) in enumerate(cases.items()):
        columns = [case.lines.names.index(name) for name in (_LINES[0], case.line)]
        for number, port in enumerate(ports):
            if port in loads[option]:
                force[row, :, number] = loads[option][port][:3, columns].T
    coords = {
        "shown_option": list(cases),
        "section_line": list(_LINES),
        "load_port": [port.name for port in ports],
        "axis": list(AXES),
    }
    labelled = stamped({"section_force": force}, coords)
    heights = [height_m(port, machine) for port in ports]
    return labelled.assign_coords(load_port_height=("load_port", heights))


def height_m(port: Port, machine: Machine) -> float:
    """Return the height of the loaded body above the centre of mass of that on the feet, m."""
    if isinstance(port, Part):
        if machine.has_table(Frame):
            return float(getattr(machine.table(Frame), port.name).height_m)
        return float(getattr(machine.table(ShellStructure), port.joint).height_m)
    return 0.0 if port != BLOCK or machine.suspension is None else machine.suspension.height_m
