"""Spectra of overlapping blocks over a run-up: order maps and rpm-frequency maps."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ..errors import ParameterError
from .angular import AngularSignal, check_finite, known_samples
from .crank_motion import CrankMotion
from .fourier import real_transform
from .windows import Window, window_by_name

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_CHUNK_SAMPLES: Final = 2**18
"""Windowed at once in each thread: 2 MB, and 2 MB of their spectra."""
_THREADS: Final = 2


@dataclass(frozen=True)
class OrderMap:
    """Order spectra of blocks of whole revolutions."""

    amplitude: ComplexArray
    """Complex peak against crank angle zero, x = Re{X e^{+jkθ}}, shape (..., block, order)."""
    order: Array
    """Multiples of 1 / revolutions, shape (order,)."""
    revolutions: int
    """In each block."""
    window: Window
    starts: NDArray[np.int64]
    """First sample of the blocks in the signal, shape (block,)."""
    time_s: Array
    """Middle of the blocks, shape (block,)."""
    shaft_frequency_hz: Array
    """Mean over each block, shape (block,)."""

    @property
    def resolution_order(self) -> float:
        """Noise bandwidth of a line, orders: the resolution really obtained."""
        return self.window.noise_bandwidth_lines / self.revolutions

    @property
    def main_lobe_order(self) -> float:
        """Width of a line's main lobe from zero to zero, orders."""
        return self.window.main_lobe_lines / self.revolutions


@dataclass(frozen=True)
class FrequencyMap:
    """Spectra of blocks of equal duration, labelled with the speed."""

    amplitude: ComplexArray
    """Complex peak against time zero, shape (..., block, frequency)."""
    frequency_hz: Array
    """Shape (frequency,)."""
    resolution_hz: float
    """Noise bandwidth of a line: the resolution really obtained."""
    time_s: Array
    """Middle of the blocks, shape (block,)."""
    shaft_frequency_hz: Array
    """Mean over each block, shape (block,)."""


def order_map(
    signal: AngularSignal,
    resolution_order: float,
    window: str = "hann",
    overlap_ratio: float = 0.5,
) -> OrderMap:
    """Order spectra over a run-up, in blocks of as few whole revolutions as resolve the orders.

    Whole revolutions put every whole order, and every multiple of 1 / revolutions, on a line.

    Parameters
    ----------
    signal : over the crank angle
    resolution_order : coarsest noise bandwidth of a line, orders; blocks span at least the
        window's noise bandwidth in lines divided by it
    window : rectangular, hann or flat_top
    overlap_ratio : share of a block that the next one covers too, from 0 to below 1

    Raises
    ------
    ParameterError
        The resolution is finer than the signal allows, or a value is outside its range.
    """
    shape = window_by_name(window)
    _check_positive("resolution_order", resolution_order)
    # A resolution of 1.5 / 12 asks for 12 revolutions, whatever its last bit.
    needed = np.ceil(shape.noise_bandwidth_lines / resolution_order * (1.0 - 1e-12))
    spanned = signal.time_s.size / signal.samples_per_revolution
    if spanned < needed:
        raise ParameterError(
            f"resolution_order = {resolution_order:g}: needs blocks of {needed:.6g} revolutions, "
            f"the signal has {spanned:.3g}"
        )
    revolutions = int(needed)
    length = revolutions * signal.samples_per_revolution
    starts = _block_starts(signal.time_s.size, length, overlap_ratio)
    lines = int(np.floor(signal.maximum_order * revolutions * (1.0 + 1e-12))) + 1
    amplitude = _block_spectra(
        signal.values, starts, starts + signal.first_sample, shape.samples(length), lines
    )
    start_s, end_s = signal.time_s[starts], signal.time_s[starts + length - 1]
    return OrderMap(
        amplitude=amplitude,
        order=np.arange(lines) / revolutions,
        revolutions=revolutions,
        window=shape,
        starts=starts,
        time_s=np.asarray((start_s + end_s) / 2.0),
        shaft_frequency_hz=(length - 1) / (signal.samples_per_revolution * (end_s - start_s)),
    )


def block_phasors(
    signal: AngularSignal, spectra: OrderMap, orders: Sequence[float] | Array
) -> ComplexArray:
    """Complex peak amplitude of any orders in the blocks of their map, (..., block, order).

    X_k = 2 / S1 Σ x w exp(-jkθ), at the order itself: on a line of the map it is that line.

    Parameters
    ----------
    signal : that the map was made of
    spectra : the map
    orders : above 0, up to the signal's maximum order

    Raises
    ------
    ParameterError
        An order is outside that range.
    """
    wanted = np.asarray(orders, dtype=float)
    for order in wanted:
        if not 0.0 < order <= signal.maximum_order:
            raise ParameterError(
                f"order {order:g}: must be above 0 and at most {signal.maximum_order:g}"
            )
    length = spectra.revolutions * signal.samples_per_revolution
    turn = 2.0 * np.pi * wanted / signal.samples_per_revolution
    weights = np.exp(-1j * np.outer(np.arange(length), turn))
    weights *= (spectra.window.samples(length) * (2.0 / length))[:, None]  # S1 = N
    to_zero = np.exp(-1j * np.outer(spectra.starts + signal.first_sample, turn))
    parts = np.concatenate([weights.real, weights.imag], axis=1)
    rows = signal.values.reshape(-1, signal.values.shape[-1])
    phasors = np.empty((len(rows), *to_zero.shape), dtype=complex)
    for phasor, row in zip(phasors, rows, strict=True):
        blocks = sliding_window_view(row, length)[spectra.starts]
        phasor.real, phasor.imag = np.split(blocks @ parts, 2, axis=1)
    phasors *= to_zero
    return phasors.reshape(*signal.values.shape[:-1], *to_zero.shape)


def frequency_map(
    signal: Array,
    sample_rate_hz: float,
    motion: CrankMotion,
    resolution_hz: float,
    window: str = "hann",
    overlap_ratio: float = 0.5,
) -> FrequencyMap:
    """Spectra over time, each labelled with the mean speed of its block (rpm-frequency map).

    Parameters
    ----------
    signal : shape (..., time), uniformly sampled; sample 0 is at time zero
    sample_rate_hz : its sample rate
    motion : crank angle over (a part of) that time; only blocks within it are taken
    resolution_hz : coarsest noise bandwidth of a line
    window : rectangular, hann or flat_top
    overlap_ratio : share of a block that the next one covers too, from 0 to below 1

    Raises
    ------
    ParameterError
        The resolution is finer than the signal allows, a value is outside its range, or a sample
        is not finite.
    """
    shape = window_by_name(window)
    _check_positive("resolution_hz", resolution_hz)
    check_finite(signal)
    needed = np.ceil(shape.noise_bandwidth_lines * sample_rate_hz / resolution_hz)
    first, end = known_samples(motion, sample_rate_hz, signal.shape[-1])
    if end - first < needed:
        raise ParameterError(
            f"resolution_hz = {resolution_hz:g} Hz: needs blocks of "
            f"{needed / sample_rate_hz:.3g} s, the signal with a known crank angle lasts "
            f"{(end - first) / sample_rate_hz:.3g} s"
        )
    length = int(needed)
    starts = first + _block_starts(end - first, length, overlap_ratio)
    lines = (length + 1) // 2
    start_s, end_s = starts / sample_rate_hz, (starts + length - 1) / sample_rate_hz
    turned = (motion.angle_rad(end_s) - motion.angle_rad(start_s)) / (2.0 * np.pi)
    return FrequencyMap(
        amplitude=_block_spectra(signal, starts, starts, shape.samples(length), lines),
        frequency_hz=np.arange(lines, dtype=float) * (sample_rate_hz / length),
        resolution_hz=shape.noise_bandwidth_lines * sample_rate_hz / length,
        time_s=(start_s + end_s) / 2.0,
        shaft_frequency_hz=turned / (end_s - start_s),
    )


def mean_order_spectrum(spectra: OrderMap) -> Array:
    """RMS of each line from the mean power over the blocks, √(mean |X|² / 2), (..., order).

    Divided by the square root of `resolution_order` it is the root of the power density of noise
    (Heinzel, Rüdiger & Schilling 2002, equation 24). Order 0 is |X_0|, its own RMS.
    """
    power = np.mean(np.abs(spectra.amplitude) ** 2, axis=-2) / 2.0
    power[..., 0] *= 2.0
    return np.asarray(np.sqrt(power))


def _check_positive(name: str, value: float) -> None:
    if not 0.0 < value < np.inf:
        raise ParameterError(f"{name} = {value:g}: must be above 0")


def _block_starts(samples: int, length: int, overlap_ratio: float) -> NDArray[np.int64]:
    if not 0.0 <= overlap_ratio < 1.0:
        raise ParameterError(f"overlap_ratio = {overlap_ratio:g}: must be from 0 to below 1")
    hop = max(round(length * (1.0 - overlap_ratio)), 1)
    return np.arange(0, samples - length + 1, hop)


def _block_spectra(
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

    def fill(job: tuple[int, int]) -> None:
        row, begin = job
        blocks = slice(begin, begin + chunk)
        windowed = sliding_window_view(rows[row], length)[starts[blocks]] * scaled
        # Modulo N, many blocks begin at the same sample, and the sine keeps all its digits.
        begins, of_block = np.unique(grid_index[blocks] % length, return_inverse=True)
        turns = np.outer(begins, np.arange(lines)) % length / length
        turned = np.exp(-2j * np.pi * turns)[of_block]
        np.multiply(real_transform(windowed)[:, :lines], turned, out=amplitude[row, blocks])

    jobs = [(row, begin) for row in range(len(rows)) for begin in range(0, starts.size, chunk)]
    with ThreadPoolExecutor(_THREADS) as pool:
        list(pool.map(fill, jobs))
    amplitude[..., 0] /= 2.0
    return amplitude.reshape(*signal.shape[:-1], starts.size, lines)
