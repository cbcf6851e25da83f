"""Velocity and displacement of a channel of acceleration that comes in pieces, without drift.

Pieces are transformed with silence on both sides, divided by (jω)^n within the band and added up:
a filter without phase error, whose output has a lower sample rate.
"""

from math import ceil
from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array

LEAST_RATE_HZ: Final = 16384.0
"""Least sample rate of the output, if the channel has it: 16 samples a period at 1 kHz."""
TICK_S: Final = 0.01
"""Length over which squares and extremes are kept."""
RINGING: Final = 2.0
"""Length of the filter's ringing on either side times the width of its edges."""
BLOCK: Final = 4
"""Length of a piece over that of the ringing."""
HIGHEST_SHARE: Final = 1.0 / 2.56
"""Highest frequency over the sample rate that an anti-aliasing filter lets through."""


class Integrator:
    """Mean squares of the velocity and extremes of the displacement of a channel, by tick.

    Parameters
    ----------
    sample_rate_hz : sample rate of the channel
    samples : number of its samples
    derivative : 2 of an acceleration, 1 of a velocity, 0 of a displacement
    band_hz : lowest and highest frequency that pass whole
    edge_hz : width of half a cosine beyond either, below the lowest frequency
    offset : mean of all samples
    """

    def __init__(
        self,
        sample_rate_hz: float,
        samples: int,
        derivative: int,
        band_hz: tuple[float, float],
        edge_hz: float,
        offset: float = 0.0,
    ) -> None:
        self._step = max(int(sample_rate_hz // LEAST_RATE_HZ), 1)
        self._rate_hz = sample_rate_hz / self._step
        self._tick = max(round(TICK_S * self._rate_hz), 1)
        self.tick_s = self._tick / self._rate_hz
        ringing = ceil(RINGING / edge_hz / self.tick_s)
        total = ceil(samples / (self._step * self._tick))
        ticks = min(BLOCK * ringing, total)
        self._before, self._ticks = ringing * self._tick, total
        self._filled, self._buffer = 0, np.zeros(ticks * self._tick * self._step)
        self._length = fft.next_fast_len(ticks * self._tick + 2 * self._before, real=True)
        frequency_hz = fft.rfftfreq(self._length, 1.0 / self._rate_hz)
        taper = _taper(frequency_hz, *band_hz, edge_hz)
        turning = 2j * np.pi * np.where(frequency_hz > 0.0, frequency_hz, 1.0)
        self._gains = [taper * turning ** (power - derivative) / self._step for power in (1, 0)]
        self._tails = np.zeros((2, self._length))
        self._offset = offset
        self._energy, self._extremes = [np.zeros(0)], [np.zeros((2, 0))]

    def add(self, piece: Array) -> None:
        """Take the next samples, shape (time,)."""
        while piece.size:
            taken = min(piece.size, self._buffer.size - self._filled)
            part = self._buffer[self._filled : self._filled + taken]
            np.subtract(piece[:taken], self._offset, out=part)
            self._filled, piece = self._filled + taken, piece[taken:]
            if self._filled == self._buffer.size:
                self._transform()

    def _transform(self) -> None:
        """Add what a full buffer makes; what no later one changes is measured."""
        done = self._buffer.size // self._step
        padded = np.zeros(self._length * self._step)
        begin = self._before * self._step
        padded[begin : begin + self._buffer.size] = self._buffer
        spectrum = fft.rfft(padded)[: self._length // 2 + 1]
        if self._step > 1:
            spectrum[-1] = 0.0  # the band ends below
        self._tails += fft.irfft(spectrum * self._gains, self._length)
        velocity, displacement = self._tails[:, :done].reshape(2, -1, self._tick)
        self._energy.append(np.sum(velocity**2, axis=1) / self._rate_hz)
        self._extremes.append(np.array([displacement.min(axis=1), displacement.max(axis=1)]))
        self._tails = np.hstack([self._tails[:, done:], np.zeros((2, done))])
        self._filled = 0
        self._buffer[:] = 0.0

    def result(self) -> tuple[Array, Array]:
        """Return ∫ v² dt, shape (tick,), m²/s, and extremes of x, shape (2, tick), m.

        Call it once, after all samples were added.
        """
        skipped = self._before // self._tick
        while sum(each.size for each in self._energy) < skipped + self._ticks:
            self._transform()
        kept = slice(skipped, skipped + self._ticks)
        return np.concatenate(self._energy)[kept], np.hstack(self._extremes)[:, kept]


def _taper(frequency_hz: Array, lowest_hz: float, highest_hz: float, edge_hz: float) -> Array:
    """One within the band, and half a cosine to zero beyond."""
    beyond = np.maximum(lowest_hz - frequency_hz, frequency_hz - highest_hz) / edge_hz
    return np.asarray(0.5 + 0.5 * np.cos(np.pi * np.clip(beyond, 0.0, 1.0)))
