"""How far the energy of a plate at one frequency lies from its mean over all plates like it."""

from typing import Final

import numpy as np
from scipy.special import exp1

from ...base.arrays import Array

GAUSSIAN: Final = 3.0
"""E[φ⁴]/E[φ²]² of mode shapes at a point, taken as Gaussian; 2.25 of a hinged rectangle."""
_FEW: Final = 1e-3
_MANY: Final = 30.0


def modal_overlap(
    frequency_hz: Array,
    mass_kg_per_m2: float,
    bending_stiffness_n_m: float,
    loss_ratio: Array,
    area_m2: float,
) -> Array:
    """Half-power band of a mode times modes a hertz: f η S/2 √(m/B), shape (...).

    Modes a hertz of a plate: Cremer, Heckl, Petersson, Structure-Borne Sound (2005).
    """  # fmt: skip
    density = 0.5 * area_m2 * np.sqrt(mass_kg_per_m2 / bending_stiffness_n_m)
    return np.asarray(frequency_hz * loss_ratio * density)


def relative_variance(overlap: Array) -> Array:
    """Variance over squared mean of the energy by one force at one frequency, shape (...).

    r² = 1/(πM) {α - 1 + (1 - e^{-2πM})/(2πM) + E1(πM) [cosh πM - sinh πM/(πM)]} with the natural
    frequencies of a random matrix (Langley and Brown, J. Sound Vib. 275 (2004) 823), α = GAUSSIAN.

    Parameters
    ----------
    overlap : M, above zero
    """
    x = np.pi * np.maximum(np.asarray(overlap, dtype=float), _FEW)
    some = np.minimum(x, _MANY)
    last = exp1(some) * (np.cosh(some) - np.sinh(some) / some)
    last = np.where(x > _MANY, 0.5 / x, last)  # E1(x) eˣ tends to 1/x
    return np.asarray((GAUSSIAN - 1.0 + (1.0 - np.exp(-2.0 * x)) / (2.0 * x) + last) / x)
