"""Vibration severity: velocity from 10 to 1000 Hz, RMS, and displacement, peak to peak.

The quantity is that of ISO 20816-1:2016 and ISO 2954:2012, whose filters have the relative
sensitivity 1 at 10 and at 1000 Hz: a tone there counts whole. Its zones depend on the machine.
"""

from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray

LOWEST_HZ, HIGHEST_HZ = 10.0, 1000.0
"""Band of the velocity; a tone at either end counts whole."""
_SAME: Final = 1e-9
"""Share by which a frequency may be beyond the band by rounding."""
_OVERSAMPLING: Final = 32
"""Angles per period of the highest order: a peak is within 0.1 %."""


def in_band(frequency_hz: Array) -> Array:
    """Return which lines count, of the same shape."""
    low, high = LOWEST_HZ * (1.0 - _SAME), HIGHEST_HZ * (1.0 + _SAME)
    return np.asarray((frequency_hz >= low) & (frequency_hz <= high))


def velocity_rms(velocity_m_s: ComplexArray, frequency_hz: Array) -> Array:
    """Return the velocity of all lines from 10 to 1000 Hz, m/s: √(Σ |v|² / 2).

    Parameters
    ----------
    velocity_m_s : complex peaks, shape (..., line)
    frequency_hz : shape (..., line), as far as it is broadcast

    Returns
    -------
    shape (...)

    Examples
    --------
    >>> velocity_rms(np.array([3e-3, 4e-3j, 1.0]), np.array([10.0, 50.0, 1200.0]))
    array(0.00353553)
    """
    square = np.where(in_band(frequency_hz), np.abs(velocity_m_s) ** 2, 0.0)
    return np.asarray(np.sqrt(0.5 * np.sum(square, axis=-1)))


def displacement_range(velocity_m_s: ComplexArray, frequency_hz: Array) -> Array:
    """Return the displacement of orders from 10 to 1000 Hz, peak to peak over a revolution, m.

    Parameters
    ----------
    velocity_m_s : complex peaks of the orders 0, 1, 2 and so on, shape (..., order)
    frequency_hz : their frequencies, shape (..., order), as far as it is broadcast

    Returns
    -------
    shape (...)
    """
    turning = np.where(frequency_hz > 0.0, 2j * np.pi * frequency_hz, 1.0)
    displacement = np.where(in_band(frequency_hz), velocity_m_s / turning, 0.0)
    samples = _OVERSAMPLING * displacement.shape[-1]
    # irfft halves and divides: real part of Σ X exp(jnθ) = samples / 2 · irfft(X).
    over_angle = 0.5 * samples * np.fft.irfft(displacement, samples, axis=-1)
    return np.asarray(np.ptp(over_angle, axis=-1))
