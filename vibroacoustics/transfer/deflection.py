"""Deflection of the housing at part frequency: as a rigid body, and by the modes of its shell."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.vocabulary import AXES, RIGID_BODY_DOFS, stamped
from ..machine.frame import Frame, Part
from ..machine.machine import Machine
from ..machine.shell import Shell
from ..machine.shell_structure import ShellStructure
from ..machine.suspension import BLOCK
from ..mechanics.loads import Lines, PortLoads, summed
from ..mechanics.ports import WRENCH, Port
from .load_path import LoadPath
from .observers import motions
from .shell_modes.modes import ShellMode
from .shell_modes.sampled import SampledMode

_ANGLES: Final[Array] = 2.0 * np.pi * np.arange(48) / 48
"""Angles of the points on a ring."""
_STATIONS: Final = 25
"""Rings over height and radius of the shell, at least; ends of its curves are among them."""


def rings(shell: Shell) -> tuple[Array, Array]:
    """Radius and height of rings around the shell, from the middle of its bottom up.

    Returns
    -------
    radius, and height above the centre of mass, shape (station,), m
    """
    profile = shell.profile
    radius, height = profile.points((profile.height_m + profile.radius_m) / _STATIONS).T
    return radius, height


def ring_points(radius_m: Array, height_m: Array) -> Array:
    """Points of the rings, shape (station, angle, 3), m.

    Parameters
    ----------
    radius_m, height_m : shape (station,)
    """
    across = radius_m[:, None, None] * np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1)
    up = np.broadcast_to(height_m[:, None, None], (*across.shape[:2], 1))
    return np.concatenate([across, up], axis=-1)


class MovingCase(NamedTuple):
    """A case at part line.

    Attributes
    ----------
    path : from its loads
    lines : loads of all sources
    line : name of a line above 0 Hz
    """

    path: LoadPath
    lines: Lines
    line: str


def deflection_variables(cases: Mapping[str, MovingCase], shell: Shell) -> xr.Dataset:
    """Label the displacements at a line of each case by all sources together."""
    radius, height = rings(shell)
    points = ring_points(radius, height)
    each = [_deflection(moving, points) for moving in cases.values()]
    coords = {
        "shown_option": list(cases),
        "station": np.arange(1.0, radius.size + 1.0),
        "station_angle": _ANGLES,
        "axis": list(AXES),
        "dof": list(RIGID_BODY_DOFS),
        "foot": list(next(iter(cases.values())).path.body.stand.names),
    }
    labelled = stamped({name: [case[name] for case in each] for name in each[0]}, coords)
    return labelled.assign_coords(
        deflection_line=("shown_option", [case.line for case in cases.values()]),
        station_radius=("station", radius),
        station_height=("station", height),
    )


def _deflection(case: MovingCase, points: Array) -> dict[str, ComplexArray | float]:
    """Displacements at points of the shell, shape (..., 3), by variable of the vocabulary."""
    column = case.lines.names.index(case.line)
    acting = summed(
        {port: load[:, [column]] for port, load in loads.items()}
        for loads in case.lines.loads.values()
    )
    frequency = float(case.lines.frequency_hz[column])
    moving = amplitudes(case.path, acting, frequency)
    rigid, feet = moving[-6:], case.path.body.foot_position
    return {
        "deflection": displacement(case.path, moving, points),
        "deflection_rigid": rigid,
        "deflection_foot": rigid[:3] + np.cross(rigid[3:], feet),
        "deflection_frequency": frequency,
    }


def amplitudes(path: LoadPath, loads: PortLoads, frequency_hz: float) -> ComplexArray:
    """Displacements of the shell's modes and then of its six rigid motions, m and rad.

    Parameters
    ----------
    path : path of the case
    loads : loads of all sources together, shape (component, 1)
    frequency_hz : above zero
    """
    count = 0 if path.shell is None else len(path.shell.path.modes)
    velocity = path.observed(motions(count), loads, np.array([frequency_hz]))[:, 0]
    return np.broadcast_to(velocity / (2j * np.pi * frequency_hz), count + 6)


def displacement(path: LoadPath, moving: ComplexArray, points: Array) -> ComplexArray:
    """Displacement of points of the shell, shape (..., 3), m.

    Parameters
    ----------
    path : path of the case
    moving : see `amplitudes`
    points : about the centre of mass, shape (..., 3), m
    """
    total = moving[-6:-3] + np.cross(moving[-3:], points)
    if path.shell is not None:
        flat = points.reshape(-1, 3)
        modes: Sequence[ShellMode | SampledMode] = path.shell.path.modes
        for number, mode in enumerate(modes):
            total += moving[number] * mode.velocity(flat).reshape(points.shape)
    return np.asarray(total)


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
