"""Mobility of the shell: forces on its modes, and their response."""

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...machine.shell_structure import Joint
from .loads import Load, mean_over_band, patch_factors
from .modes import ElasticShell


def modal_forces(shell: ElasticShell, load: Load) -> Array:
    """Generalised force of each mode per unit load, shape (mode, load): 1 for a force, 1/m for a
    moment.

    An internal pair drives a mode with the difference of its two joints.

    Parameters
    ----------
    shell : its modes
    load : unit loads
    """
    parts = [
        shapes @ load.generalised(shell.meridian, around)
        for around, (_, shapes) in shell.by_around.items()
    ]
    rows = np.concatenate([rows for rows, _ in shell.by_around.values()])
    return np.asarray(np.concatenate(parts)[np.argsort(rows)])


def patch_forces(shell: ElasticShell, joint: Joint) -> Array:
    """Generalised force of each mode per unit force outwards, up and around on each weld of a
    joint, one weld after another, shape (mode, contact).

    Parameters
    ----------
    shell : its modes
    joint : welds

    Raises
    ------
    ParameterError
        The joint reaches beyond the wall.
    """
    mean = mean_over_band(shell.meridian, joint)
    reached = np.flatnonzero(mean.any(axis=1))
    forces = np.empty((len(shell.modes), joint.welds, 3))
    factors = patch_factors(joint, list(shell.by_around))
    for (rows, shapes), factor in zip(shell.by_around.values(), factors, strict=True):
        forces[rows] = (shapes[:, reached] @ mean[reached])[:, None] * factor
    return forces.reshape(len(forces), -1)


def velocity_per_force(
    natural_hz: Array, modal_mass_kg: Array, loss_factor_ratio: float, frequency_hz: Array
) -> ComplexArray:
    """Velocity amplitude of each mode per generalised force, shape (mode, frequency), m/(N s).

    jω / (m (ω_r² (1 + jη) - ω²)).

    Parameters
    ----------
    natural_hz, modal_mass_kg : natural frequency and modal mass of the modes, shape (mode,)
    loss_factor_ratio : structural
    frequency_hz : shape (frequency,)
    """
    omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
    lossy = (2.0 * np.pi * natural_hz[:, None]) ** 2 * (1.0 + 1j * loss_factor_ratio)
    return np.asarray(1j * omega / (modal_mass_kg[:, None] * (lossy - omega**2)))
