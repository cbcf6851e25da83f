"""Fourier transforms of real samples, by FFTW where it is installed."""

from typing import Any, Final

import numpy as np

from .arrays import Array, ComplexArray

try:
    import pyfftw
except ImportError:  # FFTW is optional; scipy gives the same spectrum
    pyfftw = None
from scipy import fft as scipy_fft

FFT_ENGINE: Final = "scipy.fft" if pyfftw is None else "pyFFTW"


def real_transform(signal: Array) -> ComplexArray:
    """Real-to-complex transform along the last axis."""
    if pyfftw is None:
        return np.asarray(scipy_fft.rfft(signal, axis=-1))
    # Estimated plans: measured ones differ in the last bits from run to run.
    transform = pyfftw.builders.rfft(
        np.array(signal, dtype=float), axis=-1, planner_effort="FFTW_ESTIMATE", threads=1
    )
    return np.asarray(transform())


class BlockTransform:
    """Transform of blocks of one length, and its inverse, in memory that is used again.

    Parameters
    ----------
    length : samples of a block
    """

    def __init__(self, length: int) -> None:
        self.samples: Array = np.zeros(length)
        """The block; to be filled before `forward`."""
        self._transforms = None if pyfftw is None else _planned(length)
        if self._transforms is not None:
            self.samples = self._transforms[0].input_array

    def forward(self) -> ComplexArray:
        """Return the lines of the block; valid until the next call."""
        if self._transforms is None:
            return np.asarray(scipy_fft.rfft(self.samples))
        self._transforms[0].execute()
        return np.asarray(self._transforms[0].output_array)

    def inverse(self, lines: ComplexArray, gain: Array) -> Array:
        """Return the samples of lines times a gain, shape (line,) both; valid until the next call.

        With FFTW as with scipy the inverse of `forward` has the gain 1.
        """
        length = self.samples.size
        if self._transforms is None:
            return np.asarray(scipy_fft.irfft(lines * gain, length))
        back = self._transforms[1]
        np.multiply(lines, gain / length, out=back.input_array)
        back.execute()
        return np.asarray(back.output_array)


def _planned(length: int) -> tuple[Any, Any]:
    """Plans of FFTW for a block and its lines, with their memory."""
    samples, lines = pyfftw.zeros_aligned(length), length // 2 + 1
    flags = ("FFTW_ESTIMATE", "FFTW_DESTROY_INPUT")
    forward = pyfftw.FFTW(
        samples, pyfftw.zeros_aligned(lines, dtype=complex), flags=("FFTW_ESTIMATE",)
    )
    back = pyfftw.FFTW(
        pyfftw.zeros_aligned(lines, dtype=complex), pyfftw.zeros_aligned(length),
        direction="FFTW_BACKWARD", flags=flags,
    )  # fmt: skip
    return forward, back
