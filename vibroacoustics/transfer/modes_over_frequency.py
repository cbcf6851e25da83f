"""Natural modes where the stiffness changes with frequency."""

from collections.abc import Callable
from typing import Final

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from ..base.arrays import Array

TOLERANCE_HZ: Final = 1e-9


def modes_over_frequency(
    stiffness: Callable[[float], Array], mass: Array, stiffest_hz: float
) -> tuple[Array, Array]:
    """Undamped natural frequencies, Hz, and mass-normalised shapes, one a row.

    Mode n is where the n-th natural frequency of the stiffness at a frequency is that frequency.

    Parameters
    ----------
    stiffness : real part at a frequency in Hz, symmetric
    mass : symmetric, positive definite
    stiffest_hz : frequency that no natural frequency exceeds
    """

    def natural_hz(hertz: float) -> tuple[Array, Array]:
        squares, shapes = eigh(stiffness(hertz), mass)
        return np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi), shapes

    frequencies, rows = [], []
    for mode in range(len(mass)):
        meets = brentq(
            lambda hertz, mode=mode: natural_hz(hertz)[0][mode] - hertz,
            0.0, stiffest_hz, xtol=TOLERANCE_HZ,
        )  # fmt: skip
        at_mode = natural_hz(meets)
        frequencies.append(at_mode[0][mode])
        rows.append(at_mode[1][:, mode])
    return np.array(frequencies), np.array(rows)
