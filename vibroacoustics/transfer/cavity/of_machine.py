"""The spaces of gas that a machine's tables name, in its elastic shell."""

from collections.abc import Mapping

import numpy as np

from ...base.errors import ParameterError
from ...machine.cavities import DischargeDome
from ...machine.machine import Machine
from ...mechanics.loads import DISCHARGE_DOME
from ..path import ShellPath
from ..shell_modes.modes import ShellMode
from .in_shell import GasInShell, Mouth
from .profile import disc_profile
from .response import DrivenGas


def gas_of(machine: Machine, path: ShellPath) -> Mapping[str, DrivenGas]:
    """The machine's spaces of gas by the name of their table.

    Parameters
    ----------
    machine : their tables
    path : modes of the wall as given; it keeps the modes of the gas

    Raises
    ------
    ParameterError
        The modes of the wall are measured.
    """
    if not machine.has_table(DischargeDome):
        return {}
    dome = machine.table(DischargeDome)
    space = path.gas.get(dome.depth_m)
    if space is None:
        space = path.gas[dome.depth_m] = _under_cap(machine, path, dome.depth_m)
    radius, floor = float(space.profile.radius[-1]), float(space.profile.lower[-1])
    port = Mouth(dome.port_offset_m, floor, (dome.port_angle_rad,))
    tube = Mouth(radius, floor + dome.tube_height_m, (dome.tube_angle_rad,))
    area = 0.25 * np.pi * dome.tube_diameter_m**2
    return {DISCHARGE_DOME: space.driven(port, tube, area, dome.quality_ratio)}


def _under_cap(machine: Machine, path: ShellPath, depth_m: float) -> GasInShell:
    """The gas over a partition, within the inner surface of the wall as given."""
    if path.wall is None:
        raise ParameterError("shell_modes: measured modes and gas in the shell do not go together")
    shell, given = machine.shell, path.wall.shell
    thickness = given.structure.thickness_m
    rim = shell.height_m - max(shell.dome_height_m, thickness) - shell.centre_of_mass_height_m
    cap = max(shell.dome_height_m - thickness, 0.0)
    profile = disc_profile(shell.radius_m - thickness, cap, depth_m, rim - depth_m)
    modes = tuple(mode for mode in path.modes if isinstance(mode, ShellMode))
    return GasInShell(profile, True, given.meridian, modes)
