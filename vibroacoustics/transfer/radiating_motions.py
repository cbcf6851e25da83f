"""Sound of an elastic shell by what radiates it: its modes, its six motions as a rigid body."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level
from ..machine.frame import PARTS, Part
from ..mechanics.loads import PortLoads
from ..mechanics.ports import WRENCH
from .bending import BendingShell, rows_of
from .observers import Observers
from .shell_modes import velocity_per_force


def by_motion(
    shell: BendingShell, observers: Observers, loads: PortLoads, frequency_hz: Array
) -> ComplexArray:
    """Pressure of all loads in the shell by radiating motion.

    The sum over the motions is `LoadPath.observed`.

    Parameters
    ----------
    shell : with one set of values
    observers : microphones
    loads : on ports in the shell, of all sources together, shape (component, line)
    frequency_hz : shape (line,)

    Returns
    -------
    complex peaks, shape (mode and then rigid motion, receiver, line), Pa
    """
    gain = amplitude_of_level(shell.variation.mobility_change_db)
    per_velocity = [gain * observers.of_modes(frequency_hz), observers.rigid(frequency_hz)]
    velocity = velocities(shell, loads, frequency_hz)
    return np.moveaxis(np.concatenate(per_velocity, axis=1) * velocity, 0, 1)


def velocities(shell: BendingShell, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
    """Velocities of the shell's modes and then of its six rigid motions, (motion, line)."""
    on_parts = np.zeros((len(PARTS) * len(WRENCH), frequency_hz.size), dtype=complex)
    joined = np.zeros((len(shell.path.modes), frequency_hz.size), dtype=complex)
    beside = np.zeros_like(joined)
    for port, amplitudes in loads.items():
        if isinstance(port, Part):
            on_parts[rows_of(port)] = amplitudes
        else:
            forces = shell.modal_forces(port, frequency_hz)
            on_modes = joined if shell.frame_under(port) else beside
            on_modes += np.einsum("mcf,cf->mf", forces, amplitudes)
    if shell.frame is None:
        beside += shell.path.forces_of_parts()[..., 0] @ on_parts
        velocity: ComplexArray = np.zeros((len(joined) + 6, frequency_hz.size), dtype=complex)
    else:
        velocity = shell.frame.velocities(on_parts, joined, frequency_hz)
    velocity[:-6] += _moving(shell, frequency_hz) * beside
    return velocity


def _moving(shell: BendingShell, frequency_hz: Array) -> ComplexArray:
    """Velocity of each mode per generalised force."""
    natural_hz = shell.variation.frequency_factor_ratio * shell.path.natural_hz
    masses, loss = shell.path.modal_mass_kg, shell.loss_factor_ratio
    return velocity_per_force(natural_hz, masses, loss, frequency_hz)
