"""Order spectrum of a signal over whole revolutions of the shaft."""

import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray
from ..mechanics.rotation import crank_time_s
from .angular import check_finite, check_whole


def order_spectrum(signal: Array, maximum_order: int, revolutions: int = 1) -> ComplexArray:
    """Complex peak amplitude of each shaft order, x(θ) = Re Σ X_k exp(jkθ).

    X_0 = (1/N) Σ x and X_k = (2/N) Σ x exp(-jkθ): the one-sided Fourier series. The same as one
    block of the order map that recordings go through; a constant speed and whole revolutions leave
    no leakage, so no window and no correction for one.

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
    check_finite(signal)
    check_whole(samples, revolutions)
    return _series(signal, maximum_order, revolutions)


def order_spectrum_at_speed(
    signal: Array, speed_rad_per_s: Array, maximum_order: int
) -> ComplexArray:
    """Complex peak amplitude of each multiple of the shaft frequency, x(t) = Re Σ X_k exp(jkωt).

    X_k = (2/T) ∫ x exp(-jkωt) dt over a revolution in which the speed varies, with dt = dθ/θ̇ and
    the trapezoidal rule over crank angle. At constant speed it is `order_spectrum`.

    Parameters
    ----------
    signal : shape (..., samples), over uniform crank angles of one revolution
    speed_rad_per_s : speed of the shaft at these angles, shape (samples,)
    maximum_order : highest order to return, below half the samples

    Returns
    -------
    shape (..., maximum_order + 1), in the signal's unit, peak
    """
    if np.all(speed_rad_per_s == speed_rad_per_s[0]):
        return order_spectrum(signal, maximum_order)
    weight = 1.0 / speed_rad_per_s
    phase = crank_time_s(speed_rad_per_s) / np.mean(weight)
    waves = np.exp(-1j * np.outer(np.arange(maximum_order + 1), phase))
    kernel = 2.0 * waves * weight / np.sum(weight)
    kernel[0] *= 0.5
    return np.asarray(signal @ kernel.T)


def order_spectra(signal: Array, speed_rad_per_s: Array, maximum_order: int) -> ComplexArray:
    """`order_spectrum_at_speed` of many cases, those of constant speed at once.

    Parameters
    ----------
    signal : shape (*cases, ..., samples), over uniform crank angles of one revolution
    speed_rad_per_s : speed of the shaft at these angles, shape (*cases, samples)
    maximum_order : highest order to return, below half the samples

    Returns
    -------
    shape (*cases, ..., maximum_order + 1), in the signal's unit, peak
    """
    if np.all(speed_rad_per_s == speed_rad_per_s[..., :1]):
        return _series(signal, maximum_order)
    spectra = np.empty((*signal.shape[:-1], maximum_order + 1), dtype=complex)
    for case in np.ndindex(speed_rad_per_s.shape[:-1]):
        spectra[case] = order_spectrum_at_speed(signal[case], speed_rad_per_s[case], maximum_order)
    return spectra


def _series(signal: Array, maximum_order: int, revolutions: int = 1) -> ComplexArray:
    """One-sided Fourier series of short time histories.

    Parameters
    ----------
    signal : shape (..., samples), over whole revolutions
    maximum_order : highest order to return
    revolutions : number of revolutions
    """
    wanted = slice(0, maximum_order * revolutions + 1, revolutions)
    lines = np.asarray(fft.rfft(signal, axis=-1)[..., wanted] * (2.0 / signal.shape[-1]))
    lines[..., 0] *= 0.5
    return lines
