"""The spaces of gas that a machine's tables name, in its elastic shell."""

from collections.abc import Mapping

import numpy as np

from ...base.errors import ParameterError
from ...machine.cavities import SPACES, DischargeDome, SuctionAnnulus
from ...machine.machine import Machine
from ...machine.shell import Shell
from ..path import ShellPath
from ..shell_modes.modes import ShellMode
from .elements import Profile, annulus_profile, disc_profile
from .in_shell import GasInShell, Mouth
from .response import DrivenGas

_DOME, _ANNULUS = SPACES


def gas_of(machine: Machine, path: ShellPath) -> Mapping[str, DrivenGas]:
    """The machine's spaces of gas by the name of their table.

    Parameters
    ----------
    machine : their tables
    path : modes of the nominal wall; it keeps the modes of the gas
    """
    spaces, gas = spaces_of(machine, path), {}
    if _DOME in spaces:
        gas[_DOME] = _dome(machine.table(DischargeDome), spaces[_DOME])
    if _ANNULUS in spaces:
        gas[_ANNULUS] = _annulus(machine.table(SuctionAnnulus), spaces[_ANNULUS])
    return gas


def spaces_of(machine: Machine, path: ShellPath) -> Mapping[str, GasInShell]:
    """Return these spaces, whatever drives them; parameters and errors of `gas_of`."""
    spaces = {}
    if machine.has_table(DischargeDome):
        depth = machine.table(DischargeDome).depth_m
        if depth not in path.gas:
            profile = _under_cap(machine.shell, _thickness(path), depth)
            path.gas[depth] = _in_shell(profile, True, path)
        spaces[_DOME] = path.gas[depth]
    if machine.has_table(SuctionAnnulus):
        annulus = machine.table(SuctionAnnulus)
        bounds = annulus.inner_radius_m, annulus.lower_height_m, annulus.upper_height_m
        if bounds not in path.gas:
            inner, *faces = bounds
            radius = machine.shell.cylinder.radius_m - _thickness(path)
            profile = annulus_profile(inner, radius, *faces)
            path.gas[bounds] = _in_shell(profile, False, path)
        spaces[_ANNULUS] = path.gas[bounds]
    return spaces


def _dome(dome: DischargeDome, space: GasInShell) -> DrivenGas:
    radius, floor = float(space.profile.radius[-1]), float(space.profile.lower[-1])
    port = Mouth(dome.port_offset_m, floor, (dome.port_angle_rad,))
    tube = Mouth(radius, floor + dome.tube_height_m, (dome.tube_angle_rad,))
    area = 0.25 * np.pi * dome.tube_diameter_m**2
    return space.driven(port, tube, area, dome.quality_ratio)


def _annulus(annulus: SuctionAnnulus, space: GasInShell) -> DrivenGas:
    first, count = annulus.inlet_angle_rad, annulus.inlets
    angles = tuple(first + 2.0 * np.pi * n / count for n in range(count))
    inlets = Mouth(annulus.inner_radius_m, annulus.inlet_height_m, angles)
    return space.driven(inlets, inlets, 0.0, annulus.quality_ratio)


def _under_cap(shell: Shell, thickness_m: float, depth_m: float) -> Profile:
    size = shell.cylinder
    rim = size.height_m - max(size.dome_height_m, thickness_m) - shell.centre_of_mass_height_m
    cap = max(size.dome_height_m - thickness_m, 0.0)
    return disc_profile(size.radius_m - thickness_m, cap, depth_m, rim - depth_m)


def _thickness(path: ShellPath) -> float:
    """Thickness of the nominal wall: gas lies within its inner surface."""
    if path.wall is None:
        raise ParameterError("shell_modes: measured modes and gas in the shell do not go together")
    return path.wall.shell.structure.thickness_m


def _in_shell(profile: Profile, under_cap: bool, path: ShellPath) -> GasInShell:
    modes = tuple(mode for mode in path.modes if isinstance(mode, ShellMode))
    return GasInShell(profile, under_cap, modes[0].meridian, modes)
