"""Sound of an elastic shell by what radiates it: its modes, its six motions as a rigid body."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level
from ..mechanics.loads import Lines
from .shell_modes import velocity_per_force
from .sound_path import BendingShell


def motion_names(shell: BendingShell) -> list[str]:
    """Of the modes of a shell, in their order."""
    return [mode.name for mode in shell.path.modes]


def by_motion(shell: BendingShell, lines: Lines) -> ComplexArray:
    """Pressure of all loads on the parts, flows and loads around the yoke, by radiating motion.

    The same as `SoundPath.pressure` but summed over the sources, not over modes.

    Parameters
    ----------
    shell : with one set of values
    lines : of all sources

    Returns
    -------
    complex peaks, shape (mode and then rigid motion, receiver, line), Pa
    """
    frequency = lines.frequency_hz
    on_parts = np.sum([*lines.on_parts.values()], axis=0)
    gas, on_modes = _gas_forces(shell, lines), _yoke_forces(shell, lines)
    velocity: ComplexArray
    if shell.frame is None:
        forces = shell.path.forces_of_parts()[..., 0]
        on_modes = on_modes + gas + np.einsum("mpc,pcf->mf", forces, on_parts)
        velocity = np.zeros((len(shell.path.modes) + 6, frequency.size), dtype=complex)
    else:
        velocity = shell.frame.velocities(on_parts, gas, frequency)
    velocity[:-6] += _moving(shell, frequency) * on_modes
    gain = amplitude_of_level(shell.variation.mobility_change_db)
    per_velocity = [gain * shell.pressure_per_velocity(frequency), shell.rigid(frequency)]
    return np.moveaxis(np.concatenate(per_velocity, axis=1) * velocity, 0, 1)


def _moving(shell: BendingShell, frequency_hz: Array) -> ComplexArray:
    """Velocity of each mode per generalised force."""
    natural_hz = shell.variation.frequency_factor_ratio * shell.path.natural_hz
    masses, loss = shell.path.modal_mass_kg, shell.loss_factor_ratio
    return velocity_per_force(natural_hz, masses, loss, frequency_hz)


def _gas_forces(shell: BendingShell, lines: Lines) -> ComplexArray:
    """Of the gas in the shell on the modes, shape (mode, line)."""
    forces = np.zeros((len(shell.path.modes), lines.frequency_hz.size), dtype=complex)
    for flow in (flow for flows in lines.flows.values() for flow in flows):
        gas = shell.gas.get(flow.into)
        if gas is not None:
            state = flow.density_kg_per_m3, flow.sound_speed_m_per_s
            forces += gas.wall_forces(*state, lines.frequency_hz) * flow.volume_flow
    return forces


def _yoke_forces(shell: BendingShell, lines: Lines) -> ComplexArray:
    """Of the loads around the stator's yoke on the modes, shape (mode, line)."""
    frequency = lines.frequency_hz
    forces = np.zeros((len(shell.path.modes), frequency.size), dtype=complex)
    if shell.yoke is None or not lines.on_yoke:
        return forces
    moves = frequency > 0.0
    per_load = shell.yoke.forces(np.where(moves, frequency, 1.0)) * moves
    on_yoke = np.sum([*lines.on_yoke.values()], axis=0)
    return np.asarray(forces + np.einsum("mnof,nof->mf", per_load, on_yoke))
