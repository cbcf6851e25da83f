"""Order spectra of overlapping blocks of revolutions: order maps and what is read off them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from .angular import AngularSignal
from .block_spectra import block_spectra, block_starts, check_positive
from .windows import Window, window_by_name


@dataclass(frozen=True)
class OrderMap:
    """Order spectra of blocks of whole revolutions."""

    amplitude: ComplexArray
    """Complex peak against crank angle zero, x = Re{X e^{+jkθ}}, shape (..., block, order)."""
    order: Array
    """Multiples of 1 / revolutions, shape (order,)."""
    revolutions: int
    """Revolutions in each block."""
    window: Window
    starts: NDArray[np.int64]
    """First sample of the blocks in the signal, shape (block,)."""
    time_s: Array
    """Middle of the blocks, shape (block,)."""
    shaft_frequency_hz: Array
    """Mean over each block, shape (block,)."""

    @property
    def resolution_order(self) -> float:
        """Noise bandwidth of a line in orders, as really obtained."""
        return self.window.noise_bandwidth_lines / self.revolutions

    @property
    def main_lobe_order(self) -> float:
        """Width of a line's main lobe from zero to zero, orders."""
        return self.window.main_lobe_lines / self.revolutions


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
    per_revolution = signal.samples_per_revolution
    revolutions = block_revolutions(shape, resolution_order, signal.time_s.size / per_revolution)
    length = revolutions * per_revolution
    starts = block_starts(signal.time_s.size, length, overlap_ratio)
    lines = int(np.floor(signal.maximum_order * revolutions * (1.0 + 1e-12))) + 1
    amplitude = block_spectra(
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
        shaft_frequency_hz=(length - 1) / (per_revolution * (end_s - start_s)),
    )


def block_revolutions(window: Window, resolution_order: float, spanned: float) -> int:
    """Fewest whole revolutions of a block that resolve the orders.

    Parameters
    ----------
    window : window of the blocks
    resolution_order : coarsest noise bandwidth of a line, orders
    spanned : revolutions of the signal

    Raises
    ------
    ParameterError
        The resolution is not above zero, or finer than the signal allows.
    """
    check_positive("resolution_order", resolution_order)
    # A resolution of 1.5 / 12 asks for 12 revolutions, whatever its last bit.
    needed = np.ceil(window.noise_bandwidth_lines / resolution_order * (1.0 - 1e-12))
    if spanned < needed:
        raise ParameterError(
            f"resolution_order = {resolution_order:g}: needs blocks of {needed:.6g} revolutions, "
            f"the signal has {spanned:.3g}"
        )
    return int(needed)


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


def mean_order_spectrum(spectra: OrderMap) -> Array:
    """RMS of each line from the mean power over the blocks, √(mean |X|² / 2), (..., order).

    Divided by the square root of `resolution_order` it is the root of the power density of noise
    (Heinzel, Rüdiger & Schilling 2002, equation 24). Order 0 is |X_0|, its own RMS.
    """
    return rms_of_lines(np.mean(np.abs(spectra.amplitude) ** 2, axis=-2))


def rms_of_lines(mean_square: Array) -> Array:
    """RMS of lines from the mean squares of their peaks, from order 0 on, (..., order)."""
    power = mean_square / 2.0
    power[..., 0] *= 2.0
    return np.asarray(np.sqrt(power))
