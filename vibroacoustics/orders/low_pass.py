"""Low-pass kernel in crank angle: a sinc under a Kaiser window, and its sum over uneven samples."""

from dataclasses import dataclass
from typing import Final

import numba
import numpy as np

from ..base.arrays import Array

_PHASES: Final = 512
"""Tabulated positions between two outputs. Linear interpolation errs by at most h'' / (8 · 512²):
1e-6 of the kernel's peak, -120 dB."""
_TOGETHER: Final = 4
"""Samples between two outputs that are added at a time."""


@dataclass(frozen=True)
class LowPass:
    """Kernel h(u) = 2 c sinc(2 c u) I0(β √(1 - (u/H)²)) / I0(β), |u| <= H, u in output steps.

    Kaiser 1974 (Proc. IEEE Int. Symp. Circuits and Systems, 20-23): β = 0.1102 (A - 8.7) and a
    length of (A - 7.95) / 14.36 over the width of the transition, for an attenuation A > 50 dB in
    the stop band and as small a ripple in the pass band.
    """

    cutoff: float
    """Cut-off frequency c, of amplitude 1/2 within the transition, cycles a step."""
    half_length: int
    """H, steps."""
    kaiser_beta: float

    def kernel(self, step: Array) -> Array:
        """h at distances within the half length."""
        semicircle = np.sqrt(np.maximum(1.0 - (step / self.half_length) ** 2, 0.0))
        window = np.i0(self.kaiser_beta * semicircle) / np.i0(self.kaiser_beta)
        return np.asarray(2.0 * self.cutoff * np.sinc(2.0 * self.cutoff * step) * window)

    def table(self) -> Array:
        """h at all outputs around a sample, (position between two outputs, output)."""
        output = np.arange(1 - self.half_length, self.half_length + 1)
        return self.kernel(output - np.arange(_PHASES + 1)[:, None] / _PHASES)


def kaiser_low_pass(pass_band: float, stop_band: float, attenuation_db: float) -> LowPass:
    """Shortest kernel for the edges of its pass and stop bands, both in cycles a step."""
    length = (attenuation_db - 7.95) / (14.36 * (stop_band - pass_band))
    return LowPass(
        cutoff=(pass_band + stop_band) / 2.0,
        half_length=int(np.ceil(length / 2.0)),
        kaiser_beta=0.1102 * (attenuation_db - 8.7),
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def add_samples(signal: Array, position: Array, width: Array, table: Array, output: Array) -> None:
    """Add y(i) += Σ_n x_n h(i - u_n) Δu_n to outputs i = 1 - H, 2 - H, ...

    Parameters
    ----------
    signal : x, shape (channel, sample)
    position : u_n from 0 to the number of outputs less 2 H, in output steps, shape (sample,)
    width : Δu_n, steps between samples there, shape (sample,)
    table : values of the kernel, shape (position between two outputs, output)
    output : y, shape (channel, output); it is changed
    """
    weight = np.empty((_TOGETHER, table.shape[1]))
    n = 0
    while n < signal.shape[1]:
        floor, count = np.floor(position[n]), 0
        while (
            count < _TOGETHER
            and n + count < signal.shape[1]
            and np.floor(position[n + count]) == floor
        ):
            _weigh(position[n + count] - floor, width[n + count], table, weight[count])
            count += 1
        for channel in range(signal.shape[0]):
            samples, sums = signal[channel, n : n + count], output[channel, int(floor) :]
            if count == _TOGETHER:  # a sum is then read and written once for all
                a, b, c, d = samples[0], samples[1], samples[2], samples[3]
                for tap in range(weight.shape[1]):
                    sums[tap] += (a * weight[0, tap] + b * weight[1, tap]) + (
                        c * weight[2, tap] + d * weight[3, tap]
                    )
            else:
                for k in range(count):
                    for tap in range(weight.shape[1]):
                        sums[tap] += samples[k] * weight[k, tap]
        n += count


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _weigh(share: float, width: float, table: Array, weight: Array) -> None:
    """Kernel of a sample at a share of a step behind an output, times its width: into `weight`."""
    phase = share * (table.shape[0] - 1)
    row = int(phase)
    for tap in range(table.shape[1]):
        value = table[row, tap] + (phase - row) * (table[row + 1, tap] - table[row, tap])
        weight[tap] = width * value
