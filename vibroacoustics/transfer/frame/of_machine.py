"""A machine's frame in its shell, with the values of its tables."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...machine.frame import Frame
from ...machine.housing import Housing
from ...machine.machine import Machine
from ...machine.shell_structure import ShellVariation
from ...mechanics.critical_speed import free_scroll_shaft
from ...mechanics.scroll_shaft import ScrollShaft
from ..path import ShellPath
from ..shell_modes.projection import ProjectedModes, patch_forces
from ..shell_modes.statics import local_flexibility_factor
from .contacts import Contacts, contacts_of
from .inner import inner_set
from .on_shell import FrameOnShell

SHAFT_ELEMENT_M: Final = 0.02
"""A seventh of the wavelength of bending in the rotor at 4 kHz; cubic shapes err by 0.03 %."""


def frame_on_shell(machine: Machine, path: ShellPath) -> FrameOnShell | None:
    """The machine's frame in its shell; none where it has no frame.

    Parameters
    ----------
    machine : frame, shaft, mass, how the real shell differs
    path : modes with the machine's structure

    Raises
    ------
    ParameterError
        The modes are measured, the parts weigh more than the machine, or a contact lies beyond the
        wall.
    """
    if not machine.has_table(Frame):
        return None
    frame, wall = machine.table(Frame), path.wall
    if wall is None:
        raise ParameterError("shell_modes: measured modes and a frame do not go together")
    contacts = contacts_of(frame, path.structure, wall.shell.meridian.wall_radius_m)
    shaft = free_scroll_shaft(machine.table(ScrollShaft), SHAFT_ELEMENT_M)
    inner = inner_set(frame, shaft, contacts)
    factor = machine.table(ShellVariation).frequency_factor_ratio
    driven = np.concatenate([patch_forces(wall.shell, joint) for joint in contacts.joints], 1)
    residual = _residual(path, wall, contacts, driven) / factor**2
    on_shell = FrameOnShell(
        inner,
        contacts,
        driven[path.rows],
        residual,
        factor * path.natural_hz,
        path.modal_mass_kg,
        path.structure.loss_factor_ratio,
        _machine_mass(machine.housing),
    )
    _check_shell_mass(machine.housing, on_shell)
    return on_shell


def _residual(path: ShellPath, wall: ProjectedModes, contacts: Contacts, driven: Array) -> Array:
    """Steady flexibility at the contacts without that of the path's modes."""
    shell, rows = wall.shell, path.rows
    modes = [shell.modes[row] for row in rows]
    stiffness = np.array(
        [mode.modal_mass_kg * (2.0 * np.pi * mode.frequency_hz) ** 2 for mode in modes]
    )
    residual = wall.flexibility.at_joints(contacts.joints) - driven[rows].T @ (
        driven[rows] / stiffness[:, None]
    )
    return np.asarray(residual * local_flexibility_factor(shell.structure, path.structure))


def _machine_mass(housing: Housing) -> Array:
    moments = (housing.inertia_xx_kg_m2, housing.inertia_yy_kg_m2, housing.inertia_zz_kg_m2)
    return np.diag([*[housing.mass_kg] * 3, *moments])


def _check_shell_mass(housing: Housing, on_shell: FrameOnShell) -> None:
    if np.linalg.eigvalsh(on_shell.shell_mass)[0] <= 0.0:
        raise ParameterError(
            f"housing.mass_kg = {housing.mass_kg:g} kg: frame and shaft weigh "
            f"{on_shell.inner.rigid_mass[0, 0]:.3g} kg or turn as heavily; nothing is left for "
            "the shell"
        )
