"""Fourier transforms of blocks of real samples, and back."""

import numpy as np
from scipy import fft

from .arrays import Array, ComplexArray


class BlockTransform:
    """Transform of blocks of one length, and its inverse.

    Parameters
    ----------
    length : samples of a block
    """

    def __init__(self, length: int) -> None:
        self.samples: Array = np.zeros(length)
        """The block; to be filled before `forward`."""

    def forward(self) -> ComplexArray:
        """Return the lines of the block."""
        return np.asarray(fft.rfft(self.samples))

    def inverse(self, lines: ComplexArray, gain: Array) -> Array:
        """Return the samples of lines times a gain, shape (line,) both; of `forward` it is 1."""
        return np.asarray(fft.irfft(lines * gain, self.samples.size, overwrite_x=True))
