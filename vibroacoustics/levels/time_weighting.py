"""Fast and Slow: exponential time weighting of a signal's square (IEC 61672-1:2013)."""

from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array

FAST_TIME_CONSTANT_S: Final = 0.125
SLOW_TIME_CONSTANT_S: Final = 1.0


def time_weighted_mean_square(
    signal: Array, sample_rate_hz: float, time_constant_s: float
) -> Array:
    """(1/τ) ∫ x²(ξ) exp(-(t - ξ)/τ) dξ up to each sample.

    Exact for a square that stays constant from sample to sample. Before the recording there was
    silence: the first few time constants read low.

    Parameters
    ----------
    signal : shape (..., time), any unit
    sample_rate_hz : sample rate of the signal
    time_constant_s : τ

    Returns
    -------
    same shape, unit squared
    """
    kept = np.exp(-1.0 / (sample_rate_hz * time_constant_s))
    return np.asarray(
        scipy.signal.lfilter([1.0 - kept], [1.0, -kept], np.square(signal, dtype=float))
    )
