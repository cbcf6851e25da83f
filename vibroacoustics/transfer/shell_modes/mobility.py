"""What drives the shell's modes, and how they answer."""

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
