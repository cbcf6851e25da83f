"""Filters that start when they can, and smooth values over frequency."""

from typing import Final, TypeVar

import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray

Numbers = TypeVar("Numbers", Array, ComplexArray)
_FLOOR: Final = 1e-4
"""Share of the largest size below which the phase does not change."""
_TINY: Final = 1e-300


def least_phase(size: Array, length: int) -> ComplexArray:
    """Return sizes with the least phase that a causal response of them has, by its cepstrum.

    A. V. Oppenheim and R. W. Schafer, Discrete-Time Signal Processing, 3rd edition (2010), 13.5.

    Parameters
    ----------
    size : from the first line of the transform on, zero beyond, shape (..., frequency)
    length : length of the transform
    """
    lines = size.shape[-1]
    sizes = np.zeros((*size.shape[:-1], length // 2 + 1))
    sizes[..., 1 : lines + 1] = size
    least = _FLOOR * sizes.max(axis=-1, keepdims=True)
    cepstrum = fft.irfft(np.log(np.maximum(sizes, np.maximum(least, _TINY))), length)
    cepstrum[..., 1 : (length + 1) // 2] *= 2.0
    cepstrum[..., length // 2 + 1 :] = 0.0
    phase = fft.rfft(cepstrum).imag[..., 1 : lines + 1]
    return np.asarray(size * np.exp(1j * phase))


def between(wanted: Array, known_at: Array, values: Numbers) -> Numbers:
    """Values (..., known) at further points, smooth: level at those that are known."""
    number = np.clip(np.searchsorted(known_at, wanted) - 1, 0, known_at.size - 2)
    step = known_at[number + 1] - known_at[number]
    part = np.clip((wanted - known_at[number]) / step, 0.0, 1.0)
    part = part**2 * (3.0 - 2.0 * part)
    result: Numbers = (1.0 - part) * values[..., number] + part * values[..., number + 1]
    return result
