"""Envelopes of orders along a run-up."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from .angular import AngularSignal
from .low_pass import LowPass, kaiser_low_pass
from .order_cut import warn_of_neighbours

ENVELOPE_ATTENUATION_DB: Final = 80.0
"""Attenuation of an order a bandwidth away; modulation within the pass band keeps its size to
1e-4."""
ENVELOPE_PASS_RATIO: Final = 0.25
"""Pass band over bandwidth: 6.7 revolutions of kernel at a bandwidth of one order. A wider one
would need a longer kernel, of 20 at 0.75."""


@dataclass(frozen=True)
class OrderEnvelope:
    """Complex amplitude of orders along a run-up."""

    amplitude: ComplexArray
    """Complex peak against crank angle zero, shape (..., order, sample)."""
    order: Array
    """Shape (order,)."""
    bandwidth_order: float
    """Everything this far from an order is rejected by 80 dB; modulation of up to a quarter of it
    passes, -6 dB at 5/8."""
    revolution: Array
    """Crank angle of the samples in revolutions, shape (sample,)."""
    time_s: Array
    """Shape (sample,)."""


def synchronous_demodulation(
    signal: AngularSignal, orders: Sequence[float] | Array, bandwidth_order: float
) -> OrderEnvelope:
    """Complex envelope of orders: 2 x(θ) e^{-jkθ} after a low-pass of finite length in angle.

    Multiplying by e^{-jkθ} shifts the spectrum, so one transform of the whole signal serves all
    orders: the lines around each are weighted with the low-pass and transformed back, on a grid
    as coarse as the bandwidth allows. Half a kernel is lost at either end, 3.4 revolutions at a
    bandwidth of one order; what is left is free of end effects.

    Parameters
    ----------
    signal : over the crank angle
    orders : to demodulate
    bandwidth_order : distance to the nearest other order that is to be rejected

    Raises
    ------
    ParameterError
        The bandwidth reaches beyond the orders of the signal, an order lies within half a
        bandwidth of 0, or the signal is shorter than the kernel.

    Warns
    -----
    OrderResolutionWarning
        Two of the orders are less than a bandwidth apart.
    """
    wanted = np.asarray(orders, dtype=float)
    _check_orders(signal, wanted, bandwidth_order)
    warn_of_neighbours(wanted, bandwidth_order, f"at a bandwidth of {bandwidth_order:.3g}")
    per_revolution, size = signal.samples_per_revolution, signal.time_s.size
    low_pass = kaiser_low_pass(
        ENVELOPE_PASS_RATIO * bandwidth_order / per_revolution,
        bandwidth_order / per_revolution,
        ENVELOPE_ATTENUATION_DB,
    )
    step = _fast_step(per_revolution / (2.0 * bandwidth_order))
    lines = int(scipy.fft.next_fast_len(-(-size // step)))
    output = _under_whole_kernel(size, low_pass.half_length, step, per_revolution)
    response = _response(low_pass, lines, step)
    rows = signal.values.reshape(-1, size)
    amplitude = np.empty((len(rows), wanted.size, output.size), dtype=complex)
    for row, values in enumerate(rows):
        spectrum = scipy.fft.rfft(np.pad(values, (0, lines * step - size)))
        for number, cycles in enumerate(wanted / per_revolution):
            nearest = round(cycles * lines * step)
            envelope = _around(spectrum, nearest, response, lines * step)[output]
            # From the nearest line to the order itself, and to crank angle zero.
            turns = (cycles - nearest / (lines * step)) * step * output
            turns += cycles * signal.first_sample % 1.0
            amplitude[row, number] = envelope * np.exp(-2j * np.pi * turns)
    return OrderEnvelope(
        amplitude=amplitude.reshape(*signal.values.shape[:-1], wanted.size, output.size),
        order=wanted,
        bandwidth_order=bandwidth_order,
        revolution=signal.revolution[step * output],
        time_s=signal.time_s[step * output],
    )


def _check_orders(signal: AngularSignal, orders: Array, bandwidth: float) -> None:
    if not 0.0 < bandwidth <= signal.maximum_order:
        raise ParameterError(
            f"bandwidth_order = {bandwidth:g}: must be above 0 and at most "
            f"{signal.maximum_order:g}, the signal's highest order"
        )
    for order in orders:
        # Its image at -k lies 2k away.
        if not bandwidth / 2.0 <= order <= signal.maximum_order:
            raise ParameterError(
                f"order {order:g}: must be from {bandwidth / 2.0:g}, half the bandwidth, to "
                f"{signal.maximum_order:g}, the signal's highest order"
            )


def _fast_step(largest: float) -> int:
    """Greatest number of samples, not above `largest`, that transforms divide well."""
    step = max(int(largest), 1)
    while scipy.fft.next_fast_len(step) != step:
        step -= 1
    return step


def _under_whole_kernel(
    samples: int, half_length: int, step: int, samples_per_revolution: int
) -> NDArray[np.int64]:
    """Numbers of the coarse outputs for which the whole kernel has samples."""
    output = np.arange(-(-half_length // step), (samples - 1 - half_length) // step + 1)
    if output.size == 0:
        raise ParameterError(
            f"signal: {samples / samples_per_revolution:.3g} revolutions are too few; the "
            f"low-pass spans {2 * half_length / samples_per_revolution:.3g}; a larger "
            "bandwidth_order shortens it"
        )
    return output


def _response(low_pass: LowPass, lines: int, step: int) -> Array:
    """Gain of the low-pass at the lines around an order, in the order of a transform."""
    distance = np.arange(-low_pass.half_length, low_pass.half_length + 1)
    circular = np.zeros(lines * step)
    circular[distance] = low_pass.kernel(distance.astype(float))
    gain = scipy.fft.rfft(circular).real
    return np.asarray(gain[np.abs(_offsets(lines))])


def _offsets(lines: int) -> NDArray[np.int64]:
    """0, 1, ..., -2, -1: numbers of lines in the order of a transform."""
    return (np.arange(lines) + lines // 2) % lines - lines // 2


def _around(spectrum: ComplexArray, nearest: int, response: Array, samples: int) -> ComplexArray:
    """Twice the low-passed signal after a shift of the line `nearest` to zero, each step."""
    line = (nearest + _offsets(response.size)) % samples
    mirrored = line > samples // 2
    picked = spectrum[np.where(mirrored, samples - line, line)]
    picked = np.where(mirrored, np.conj(picked), picked)
    return np.asarray(scipy.fft.ifft(picked * response) * (2.0 * response.size / samples))
