"""Spectra of key forces: periodic part by order, the rest as spectral density by frequency."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError


def split_periodic(force_n: Array, revolutions: int) -> tuple[Array, Array]:
    """Split forces into their mean revolution and the rest, which does not repeat.

    When a force never repeats, the mean keeps 1/revolutions of the power.

    Parameters
    ----------
    force_n : whole revolutions, shape (..., samples)
    revolutions : their number

    Returns
    -------
    mean, rest : shapes (..., samples of a revolution) and (..., samples)
    """
    turns = force_n.reshape(*force_n.shape[:-1], revolutions, -1)
    mean = turns.mean(axis=-2)
    return mean, (turns - mean[..., None, :]).reshape(force_n.shape)


def spectral_density(
    force_n: Array, sample_rate_hz: float, block_samples: int, highest_hz: float = np.inf
) -> tuple[Array, ComplexArray]:
    """One-sided spectral densities of forces and of their pairs (Welch 1967): N²/Hz.

    S_ij = 2/(f_s Σ w²) <X_i* X_j> over blocks that overlap by half, Hann window. A weighted sum
    Σ h_i f_i has the density Σ h_i* S_ij h_j, which keeps the phases between the keys.

    Parameters
    ----------
    force_n : shape (forces, samples)
    sample_rate_hz : samples a second
    block_samples : length of a block, even; several revolutions resolve the orders
    highest_hz : lines up to here

    Returns
    -------
    frequency_hz, density : shapes (lines,) and (forces, forces, lines)

    Raises
    ------
    ParameterError
        The block is odd, or longer than the forces.
    """
    if block_samples % 2 or not 2 <= block_samples <= force_n.shape[-1]:
        raise ParameterError(
            f"block_samples = {block_samples}: must be even and from 2 to {force_n.shape[-1]}"
        )
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(block_samples) / block_samples)
    blocks = sliding_window_view(force_n, block_samples, axis=-1)[:, :: block_samples // 2]
    frequency = np.fft.rfftfreq(block_samples, 1.0 / sample_rate_hz).astype(float)
    share = np.where((frequency > 0.0) & (np.arange(frequency.size) < block_samples // 2), 2.0, 1.0)
    kept = frequency <= highest_hz
    spectra = np.fft.rfft(blocks * window, axis=-1)[..., kept]
    products = np.einsum("ibf,jbf->ijf", spectra.conj(), spectra, optimize=True)
    density = products * (share[kept] / (sample_rate_hz * np.sum(window**2) * blocks.shape[1]))
    return frequency[kept], np.asarray(density)
