"""The broadband pulse that drives both sides, and the running Fourier transform that records it."""

from typing import Final

import numpy as np

from .arrays import Array, ComplexArray, IndexArray

_LEAD_WIDTHS: Final = 6.0
_BLOCK_STEPS: Final = 64


def pulse_width_s(maximum_frequency_hz: float) -> float:
    """Width of the pulse: its spectrum still has 12 % of its peak at the highest frequency.

    Below 1 kHz the width stays at 0.425 ms, which keeps runs short and still has next to nothing
    above what the coarsest permitted grid carries.
    """
    return 0.425 / max(maximum_frequency_hz, 1000.0)


def pulse(time_s: Array, width_s: float) -> Array:
    """Derivative of a Gaussian, peak near 0.6, zero mean, centred six widths after time 0.

    Zero mean keeps the air at rest afterwards: nothing static remains in the grid.
    """
    argument = time_s / width_s - _LEAD_WIDTHS
    return np.asarray(-argument * np.exp(-(argument**2) / 2.0))


def pulse_duration_s(width_s: float) -> float:
    """Time after which the pulse is over (below 1e-7 of its peak)."""
    return 2.0 * _LEAD_WIDTHS * width_s


def sampling_steps(width_s: float, time_step_s: float) -> int:
    """Time steps between samples of a field that the pulse drives.

    The pulse's spectrum f exp(-(2 pi f s)²/2) is below 1e-9 of its peak from 1.1/s on. Sampled
    there at 2.2/s nothing folds back; what grid noise lies above is not driven.
    """
    return max(1, int(width_s / (2.2 * time_step_s)))


def transform(frequency_hz: Array, time_s: Array, signal: Array) -> ComplexArray:
    """Sum of s(t) exp(-j 2 pi f t), shape (frequency,)."""
    return np.asarray(np.exp(-2j * np.pi * np.outer(frequency_hz, time_s)) @ signal)


def transform_bytes(frequencies: int, signals: float) -> float:
    """Memory of a running transform: its sums, what a block adds to them, and the block."""
    return 8.0 * signals * (2 * 2 * frequencies + _BLOCK_STEPS)


class RunningTransform:
    """Fourier transform of many signals at chosen frequencies, without storing the signals.

    Samples collect in a block of a few dozen steps; a full block is one real matrix product.
    """

    def __init__(self, frequency_hz: Array, points: int) -> None:
        self._frequency = frequency_hz
        self._times = np.zeros(_BLOCK_STEPS)
        self._block = np.zeros((_BLOCK_STEPS, points))
        self._sum = np.zeros((2 * frequency_hz.size, points))
        self._filled = 0

    def next_row(self, time_s: float) -> Array:
        """Row (points,) into which the caller writes the samples of this time."""
        if self._filled == _BLOCK_STEPS:
            self._flush()
        self._times[self._filled] = time_s
        self._filled += 1
        return np.asarray(self._block[self._filled - 1])

    def _flush(self) -> None:
        angle = 2 * np.pi * np.outer(self._frequency, self._times[: self._filled])
        kernel = np.concatenate([np.cos(angle), -np.sin(angle)])
        self._sum += kernel @ self._block[: self._filled]
        self._filled = 0

    def spectrum(self, chosen: IndexArray | slice = slice(None)) -> ComplexArray:
        """Sum of the samples so far times exp(-j 2 pi f t), (chosen frequency, point)."""
        self._flush()
        count = self._frequency.size
        result: ComplexArray = np.empty(self._sum[:count][chosen].shape, dtype=complex)
        result.real, result.imag = self._sum[:count][chosen], self._sum[count:][chosen]
        return result
