"""Levels of blocks of a signal, from their spectra."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from .weighting import WEIGHTING


def block_levels(
    spectra_pa: ComplexArray, frequency_hz: Array, resolution_hz: float, weighting: str
) -> Array:
    """Level of each block, all lines above 0 Hz together, dB re 20 µPa.

    By Parseval's theorem, with the window's noise bandwidth taken off (Heinzel, Rüdiger and
    Schilling 2002, equations 21 to 24).

    Parameters
    ----------
    spectra_pa : complex peaks, shape (..., block, frequency), Pa
    frequency_hz : shape (frequency,), evenly spaced from 0
    resolution_hz : noise bandwidth of a line
    weighting : A, C or Z

    Returns
    -------
    shape (..., block)
    """
    lines = resolution_hz / (frequency_hz[1] - frequency_hz[0])
    gain = power_of_level(WEIGHTING[weighting](frequency_hz[1:]))
    square = np.sum(gain * np.abs(spectra_pa[..., 1:]) ** 2, axis=-1) / (2.0 * lines)
    return mean_square_level(square, REFERENCE_PRESSURE_PA)
