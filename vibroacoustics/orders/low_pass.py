"""Low-pass kernel in crank angle: a sinc under a Kaiser window, and its sum over uneven samples."""

from dataclasses import dataclass
from typing import Final

import numba
import numpy as np

from ..base.arrays import Array

_PHASES: Final = 512
"""Tabulated positions between two outputs. Linear interpolation errs by at most h'' / (8 · 512²):
1e-6 of the kernel's peak, -120 dB."""


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
    taps = table.shape[1]
    weight = np.empty(taps)
    for n in range(signal.shape[1]):
        floor = np.floor(position[n])
        phase = (position[n] - floor) * (table.shape[0] - 1)
        row = int(phase)
        share = phase - row
        for tap in range(taps):
            weight[tap] = table[row, tap] + share * (table[row + 1, tap] - table[row, tap])
        first = int(floor)
        for channel in range(signal.shape[0]):
            value = signal[channel, n] * width[n]
            for tap in range(taps):
                output[channel, first + tap] += value * weight[tap]
