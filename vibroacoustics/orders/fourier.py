"""The Fourier transform of real samples, by FFTW where it is installed."""

from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray

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
