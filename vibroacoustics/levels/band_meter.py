"""Mean square in bands of a channel that comes in pieces, from transforms of ten seconds."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .bands import Band, band_mean_square

TRANSFORM_S: Final = 10.0
"""Its lines lie 0.1 Hz apart, a sixtieth of the third octave at 25 Hz."""
_RAMP_SHARE: Final = 4
"""A quarter of a transform is ramp at either end: tones leak less than without."""


class BandMeter:
    """Mean square in bands, without weighting; a channel of up to ten seconds is transformed once.

    A longer one is transformed under ramps whose squares add up to one: all frequencies together
    still give the mean square to rounding.

    Parameters
    ----------
    samples : number of all samples of the channel
    sample_rate_hz : sample rate of the channel
    bands : below half the sample rate
    offset : mean of all samples of the channel, which is no sound
    """

    def __init__(
        self, samples: int, sample_rate_hz: float, bands: Sequence[Band], offset: float = 0.0
    ) -> None:
        self._samples, self._rate_hz, self._bands = samples, sample_rate_hz, bands
        self._offset = offset
        self._length = max(min(round(TRANSFORM_S * sample_rate_hz), samples), _RAMP_SHARE)
        ramp = self._length // _RAMP_SHARE
        self._rise = np.sin(0.5 * np.pi * (np.arange(ramp) + 0.5) / ramp)
        self._rest = samples  # of the channel that are still to come
        self._is_first = True
        self._buffer = np.empty(self._length)  # of the transform that comes next
        self._filled = 0
        self._energy = np.zeros(len(bands))

    def add(self, piece: Array) -> None:
        """Take the next samples of the channel.

        Raises
        ------
        ParameterError
            There are more than planned.
        """
        if piece.size > self._rest:
            raise ParameterError(f"signal: more than the {self._samples} samples planned")
        while piece.size:
            taken = min(piece.size, self._buffer.size - self._filled)
            to = self._buffer[self._filled : self._filled + taken]
            np.subtract(piece[:taken], self._offset, out=to)
            self._filled, self._rest = self._filled + taken, self._rest - taken
            piece = piece[taken:]
            if self._rest == 0 or self._filled == self._buffer.size:
                self._transform()

    def _transform(self) -> None:
        """Take the samples of the buffer, and begin the next one with those under its rise."""
        ramp, samples = self._rise.size, self._buffer[: self._filled].copy()
        next_ones = samples[samples.size - ramp :].copy()
        if not self._is_first:
            samples[:ramp] *= self._rise
        if self._rest:
            samples[samples.size - ramp :] *= self._rise[::-1]
            self._buffer[:ramp] = next_ones
        self._energy += band_mean_square(samples, self._rate_hz, self._bands) * samples.size
        self._is_first, self._filled = False, ramp

    def mean_square(self) -> Array:
        """Mean square in each band, after all samples have been added, shape (band,), unit
        squared."""
        return np.asarray(self._energy / self._samples)
