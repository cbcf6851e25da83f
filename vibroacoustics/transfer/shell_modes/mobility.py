"""Response of the elastic shell to forces, by modal sum and a residual for the other modes."""

import numpy as np

from ...base.arrays import Array, ComplexArray
from .loads import Load
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
    by_around = {
        around: load.generalised(shell.meridian, around)
        for around in {mode.around for mode in shell.modes}
    }
    rows = [mode.shape @ by_around[mode.around] for mode in shell.modes]
    return np.array(rows).reshape(len(rows), -1)


def velocity_per_force(
    natural_hz: Array, modal_mass_kg: Array, loss_factor_ratio: float, frequency_hz: Array
) -> ComplexArray:
    """Velocity amplitude of each mode per generalised force, shape (mode, frequency), m/(N s).

    jω / (m (ω_r² (1 + jη) - ω²)).

    Parameters
    ----------
    natural_hz, modal_mass_kg : of the modes, shape (mode,)
    loss_factor_ratio : structural
    frequency_hz : shape (frequency,)
    """
    omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
    lossy = (2.0 * np.pi * natural_hz[:, None]) ** 2 * (1.0 + 1j * loss_factor_ratio)
    return np.asarray(1j * omega / (modal_mass_kg[:, None] * (lossy - omega**2)))


def modal_mobility(shell: ElasticShell, frequency_hz: Array) -> ComplexArray:
    """`velocity_per_force` of a shell's modes, shape (mode, frequency).

    Parameters
    ----------
    shell : modes and loss factor
    frequency_hz : shape (frequency,)
    """
    natural = np.array([mode.frequency_hz for mode in shell.modes])
    mass = np.array([mode.modal_mass_kg for mode in shell.modes])
    return velocity_per_force(natural, mass, shell.structure.loss_factor_ratio, frequency_hz)


def static_flexibility(shell: ElasticShell, response: Load, load: Load) -> Array:
    """Elastic displacement under unit loads, solved directly, shape (response, load), m/N.

    Of all orders around that have a mode; the rigid motion is left out.

    Parameters
    ----------
    shell : stiffness
    response : where and along what the displacement counts
    load : unit loads
    """
    total: Array = np.zeros(())
    for harmonic in shell.harmonics:
        for around in shell.arounds(harmonic.order):
            given = load.generalised(shell.meridian, around)
            moved = harmonic.elastic_flexibility(given, shell.maximum_frequency_hz)
            total = total + response.generalised(shell.meridian, around).T @ moved
    return total


def residual_flexibility(shell: ElasticShell, response: Load, load: Load) -> Array:
    """What the modes leave of the static flexibility, shape (response, load), m/N.

    Parameters
    ----------
    shell : modes and stiffness
    response : where and along what the displacement counts
    load : unit loads
    """
    stiffness = np.array(
        [mode.modal_mass_kg * (2.0 * np.pi * mode.frequency_hz) ** 2 for mode in shell.modes]
    )
    modal = modal_forces(shell, response).T / stiffness @ modal_forces(shell, load)
    return np.asarray(static_flexibility(shell, response, load) - modal)


def mobility(shell: ElasticShell, response: Load, load: Load, frequency_hz: Array) -> ComplexArray:
    """Velocity per unit load, shape (response, load, frequency), m/(N s) for forces.

    Modal sum, and the modes above the highest frequency by their stiffness.

    Parameters
    ----------
    shell : modes, stiffness and loss factor
    response : where and along what the velocity counts
    load : unit loads
    frequency_hz : shape (frequency,)
    """
    by_mode = modal_mobility(shell, frequency_hz)
    modal = np.einsum(
        "mr,ml,mf->rlf", modal_forces(shell, response), modal_forces(shell, load), by_mode
    )
    omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
    rest = residual_flexibility(shell, response, load) / (
        1.0 + 1j * shell.structure.loss_factor_ratio
    )
    return np.asarray(modal + 1j * omega * rest[..., None])
