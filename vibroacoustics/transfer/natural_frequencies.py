"""Natural frequencies above those on the mounts: of the shell with its frame, of gas in it."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from scipy.linalg import block_diag, eigh

from ..base.arrays import Array
from ..base.vocabulary import check, stamp
from ..machine.cavities import GasPort
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..mechanics.loads import Loads
from .cavity.of_machine import spaces_of
from .frame.of_machine import frame_on_shell
from .frame.on_shell import FrameOnShell
from .path import ShellPath

_FREE_HZ: Final = 1.0
"""Frequency below which parts and shell move without strain."""
Named = dict[str, float]


def natural_variables(
    machine: Machine, path: ShellPath, loads: Mapping[str, Loads], highest_hz: float
) -> xr.Dataset:
    """Label the natural frequencies of shell and gas, without loss, up to a frequency.

    Parameters
    ----------
    machine : nominal machine
    path : modes of its shell
    loads : loads of all sources in one case; their ports say how fast sound is in the spaces of gas
    highest_hz : highest frequency of the sound
    """
    named = {
        "shell": shell_frequencies(machine, path),
        "gas": gas_frequencies(machine, path, sound_speeds(loads)) if path.wall else {},
    }
    arrays = {}
    for what, every in named.items():
        kept = {name: hertz for name, hertz in every.items() if hertz <= highest_hz}
        if kept:
            coords = {f"{what}_mode": list(kept)}
            arrays[f"{what}_frequency"] = stamp(f"{what}_frequency", list(kept.values()), coords)
    return check(xr.Dataset(arrays))


def shell_frequencies(machine: Machine, path: ShellPath) -> Named:
    """Frequencies of the shell, with the parts in it where the machine has a frame, by name, Hz,
    rising."""
    shell = path.with_structure(machine.table(ShellStructure))
    frame = frame_on_shell(machine, shell)
    if frame is not None:
        hertz = framed_hz(frame)
        return {
            f"with_parts_{number:03d}": float(frequency_hz)
            for number, frequency_hz in enumerate(hertz, 1)
        }
    factor = machine.table(ShellVariation).frequency_factor_ratio
    named = zip((mode.name for mode in shell.modes), factor * shell.natural_hz, strict=True)
    return {name: float(hertz) for name, hertz in sorted(named, key=lambda entry: entry[1])}


def framed_hz(frame: FrameOnShell) -> Array:
    """Frequencies of shell and parts joined at their contacts, without loss, free in space, Hz,
    rising.

    Coordinates are the shell's modes, its six rigid motions and the degrees of freedom of the
    parts; the gaps at the contacts are held by their springs in series with what the modes lack,
    those at the bearings by the metal: above the shaft's speed a film is many times as stiff.
    """
    inner = frame.inner
    squares = (2.0 * np.pi * frame.natural_hz) ** 2
    rigid = np.zeros((6, 6))
    shell = np.hstack([frame.modal_forces.T, frame.contacts.rigid])
    gaps = np.hstack([np.pad(shell, ((0, len(inner.gaps) - len(shell)), (0, 0))), -inner.gaps])
    held = np.linalg.inv(np.diag(1.0 / frame.contacts.stiffness.real) + frame.residual)
    metal = np.repeat([bearing.metal_stiffness.real for bearing in inner.bearings], 2)
    held = block_diag(held, np.diag(metal))
    stiffness = block_diag(
        np.diag(frame.modal_mass_kg * squares), rigid, inner.bodies.stiffness, inner.shaft.stiffness
    )
    mass = block_diag(np.diag(frame.modal_mass_kg), frame.shell_mass, inner.mass)
    stiffness += gaps.T @ held @ gaps
    values = eigh(stiffness, mass, eigvals_only=True, check_finite=False)
    hertz = np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)
    return np.asarray(hertz[hertz > _FREE_HZ])


def gas_frequencies(machine: Machine, path: ShellPath, sound_speed: Mapping[str, float]) -> Named:
    """Natural frequencies of the gas that sources feed, in rigid walls, by name, Hz, rising.

    Parameters
    ----------
    machine : machine with the tables of its gas spaces
    path : modes of the nominal wall
    sound_speed : speed of sound by the name of the table of a space that a source feeds, m/s
    """
    named = {}
    for name, space in spaces_of(machine, path).items():
        for gas in space.orders if name in sound_speed else ():
            numbers = np.sqrt(gas.modes[0])
            hertz = sound_speed[name] * numbers[numbers > 0.0] / (2.0 * np.pi)
            for number, frequency_hz in enumerate(hertz[hertz > _FREE_HZ], 1):
                named[f"{name}_n{gas.order}_{number}"] = float(frequency_hz)
    return dict(sorted(named.items(), key=lambda entry: entry[1]))


def sound_speeds(loads: Mapping[str, Loads]) -> dict[str, float]:
    """Speeds of sound in the spaces of gas that the loads feed, by the name of their table, m/s."""
    ports = (port for load in loads.values() for port in load.ports)
    return {port.name: port.sound_speed_m_per_s for port in ports if isinstance(port, GasPort)}
