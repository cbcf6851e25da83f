"""Windowed Fourier spectra of overlapping blocks of a signal."""

from concurrent.futures import ThreadPoolExecutor
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy import fft

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

_CHUNK_SAMPLES: Final = 2**18
"""Windowed at once in each thread: 2 MB, and 2 MB of their spectra."""
_THREADS: Final = 2


def check_positive(name: str, value: float) -> None:
    """Refuse a setting that is not above zero."""
    if not 0.0 < value < np.inf:
        raise ParameterError(f"{name} = {value:g}: must be above 0")


def block_starts(samples: int, length: int, overlap_ratio: float) -> NDArray[np.int64]:
    """First samples of blocks of a length, (block,)."""
    return np.arange(0, samples - length + 1, block_hop(length, overlap_ratio))


def block_hop(length: int, overlap_ratio: float) -> int:
    """Samples from the start of a block to that of the next.

    Raises
    ------
    ParameterError
        The overlap is outside its range.
    """
    if not 0.0 <= overlap_ratio < 1.0:
        raise ParameterError(f"overlap_ratio = {overlap_ratio:g}: must be from 0 to below 1")
    return max(round(length * (1.0 - overlap_ratio)), 1)


def block_spectra(
    signal: Array,
    starts: NDArray[np.int64],
    grid_index: NDArray[np.int64],
    window: Array,
    lines: int,
) -> ComplexArray:
    """Complex peak amplitudes of blocks, shape (..., block, line).

    X_m = 2 / S1 Σ x w exp(-j 2π m n / N), X_0 half of it (Heinzel, Rüdiger & Schilling 2002,
    equation 23), with n counted from grid index 0, where `grid_index` are those of the blocks'
    first samples: blocks have the phase of the whole, not each its own.
    """
    length = window.size
    rows = signal.reshape(-1, signal.shape[-1])
    amplitude = np.empty((rows.shape[0], starts.size, lines), dtype=complex)
    scaled = window * (2.0 / length)  # S1 = N
    chunk = max(_CHUNK_SAMPLES // length, 1)

    def fill(job: tuple[slice, int]) -> None:
        some, begin = job
        blocks = slice(begin, begin + chunk)
        windowed = sliding_window_view(rows[some], length, axis=-1)[:, starts[blocks]] * scaled
        # Modulo N, many blocks begin at the same sample, and the sine keeps all its digits.
        begins, of_block = np.unique(grid_index[blocks] % length, return_inverse=True)
        turns = np.outer(begins, np.arange(lines)) % length / length
        turned = np.exp(-2j * np.pi * turns)[of_block]
        np.multiply(fft.rfft(windowed)[..., :lines], turned, out=amplitude[some, blocks])

    each = [slice(row, row + 1) for row in range(len(rows))]
    jobs = [(row, begin) for row in each for begin in range(0, starts.size, chunk)]
    if rows.shape[0] * starts.size * length <= _CHUNK_SAMPLES:  # less work than threads are
        fill((slice(None), 0))
    else:
        with ThreadPoolExecutor(_THREADS) as pool:
            list(pool.map(fill, jobs))
    amplitude[..., 0] /= 2.0
    return amplitude.reshape(*signal.shape[:-1], starts.size, lines)
