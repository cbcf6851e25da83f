"""Natural frequencies of a rotor that does not spin."""

import numpy as np
from scipy.linalg import eigh

from vibroacoustics.base.arrays import Array
from vibroacoustics.mechanics.beam_rotor import RotorMatrices


def natural_frequencies_hz(rotor: RotorMatrices, support: Array | None = None) -> Array:
    """Natural frequencies at rest, each plane's, with an added support stiffness in N/m.

    Rigid-body motions of a free rotor come out as zero to rounding.
    """
    stiffness = rotor.stiffness if support is None else rotor.stiffness + support
    squared = eigh(stiffness, rotor.mass, eigvals_only=True)
    return np.asarray(np.sqrt(np.abs(squared)) / (2.0 * np.pi))
