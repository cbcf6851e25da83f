"""Recording a simulated field at the points of a box: in space, in time, at chosen frequencies."""

from typing import Final

import numpy as np

from .arrays import Array, ComplexArray
from .band_limited import Interpolator
from .box import Box, BoxField
from .pulse import RunningTransform
from .room_grid import RoomGrid

_LARGEST_ALIAS: Final = 1e-8
"""Of the pulse's spectrum at any frequency, what decimation may fold onto it."""
_COPIES_OF_SPECTRA: Final = 4
"""Spectra that exist at once: sums and their update, result and its parts."""
_BUFFERED_SAMPLES: Final = 64


def steps_per_sample(time_step_s: float, frequency_hz: Array, pulse_width_s: float) -> int:
    """Number of time steps from one recorded sample to the next.

    The pulse's spectrum is x exp(-x^2/2) with x = 2 pi f s. Sampling at the rate r folds the
    spectrum at r - f onto f; the longest interval is chosen that keeps this below 1e-8 at all
    frequencies.
    """

    def spectrum(frequency: Array) -> Array:
        x = 2 * np.pi * frequency * pulse_width_s
        value: Array = x * np.exp(-(x**2) / 2)
        return value

    steps = 1
    while True:
        folded = 1 / ((steps + 1) * time_step_s) - frequency_hz
        quiet = (folded > frequency_hz) & (
            spectrum(folded) <= _LARGEST_ALIAS * spectrum(frequency_hz)
        )
        if not quiet.all():
            return steps
        steps += 1


class BoxRecorder:
    """Spectra at the points of a box from samples of the grid's block around it."""

    def __init__(self, grid: RoomGrid, box: Box, frequency_hz: Array) -> None:
        points = np.concatenate([box.inner, box.outer])
        self._pairs = len(box.inner)
        self._interpolator = Interpolator(
            grid.block_origin, grid.spacing_m, grid.block_shape, points
        )
        self._transform = RunningTransform(frequency_hz, len(points))

    def add(self, time_s: float, block: Array) -> None:
        """Add a sample of the block (x, y, z)."""
        self._transform.next_row(time_s)[:] = self._interpolator(block)

    def field(self, divisor: ComplexArray) -> BoxField:
        """Sum of samples times exp(-j 2 pi f t), divided by a spectrum (frequency,)."""
        spectrum = self._transform.spectrum()
        spectrum /= divisor[:, None]
        return BoxField(spectrum[:, : self._pairs], spectrum[:, self._pairs :])


def recorder_bytes(box: Box, frequencies: int) -> float:
    """Memory that recording takes at its peak."""
    points = 2.0 * len(box.inner)
    return points * (16.0 * _COPIES_OF_SPECTRA * frequencies + 8.0 * _BUFFERED_SAMPLES)
