"""Order spectrum of a signal over whole revolutions of the shaft."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

try:
    import pyfftw
except ImportError:  # FFTW is optional; scipy gives the same spectrum
    pyfftw = None
from scipy import fft as scipy_fft

FFT_ENGINE: Final = "scipy.fft" if pyfftw is None else "pyFFTW"


def order_spectrum(
    signal: NDArray[np.float64], maximum_order: int, revolutions: int = 1
) -> NDArray[np.complex128]:
    """Complex peak amplitude of each shaft order, x(θ) = Re Σ X_k exp(jkθ).

    X_0 = (1/N) Σ x and X_k = (2/N) Σ x exp(-jkθ): the one-sided Fourier series. A constant speed
    and whole revolutions leave no leakage, so no window and no correction for one.

    Parameters
    ----------
    signal : shape (..., samples), uniformly sampled over whole revolutions
    maximum_order : highest order to return, below half the samples per revolution
    revolutions : number of revolutions that the samples span

    Returns
    -------
    shape (..., maximum_order + 1), in the signal's unit, peak

    Raises
    ------
    ValueError
        The samples do not reach the highest order.
    """
    samples = signal.shape[-1]
    if 2 * maximum_order * revolutions >= samples:
        raise ValueError(
            f"maximum_order {maximum_order} needs more than {2 * maximum_order * revolutions} "
            f"samples, got {samples}"
        )
    lines = real_transform(signal)[..., ::revolutions][..., : maximum_order + 1]
    spectrum = 2.0 / samples * lines
    spectrum[..., 0] /= 2.0
    return np.asarray(spectrum)


def real_transform(signal: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Real-to-complex transform along the last axis, by FFTW where it is installed."""
    if pyfftw is None:
        return np.asarray(scipy_fft.rfft(signal, axis=-1))
    # Estimated plans: measured ones differ in the last bits from run to run.
    transform = pyfftw.builders.rfft(
        np.array(signal, dtype=float), axis=-1, planner_effort="FFTW_ESTIMATE", threads=1
    )
    return np.asarray(transform())
