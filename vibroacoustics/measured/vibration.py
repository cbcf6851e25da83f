"""Vibration severity of the channels of a recording: overall, and of its blocks."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import stamp
from ..levels.recorded import windowed_mean_square
from ..mechanics.severity import HIGHEST_HZ, LOWEST_HZ
from ..orders.integrated import HIGHEST_SHARE, RINGING, Integrator
from ..recordings.measured_function import DERIVATIVES

EDGES_HZ: Final = (0.2, 2.0)
"""Least and greatest width of the band's edges over a whole recording."""
BLOCK_EDGE_HZ: Final = 1.0
"""Width of the band's edges over blocks, which keeps their times apart."""
MOST_OMITTED: Final = 0.25
"""Largest share of a recording that is omitted at either end."""


class VibrationLevels:
    """Velocity and displacement of the channels of vibration that come in blocks.

    Over a whole recording of T seconds the band's edges are 8/T wide, 0.2 to 2 Hz, over blocks
    1 Hz: nothing below 10 Hz less that width counts, and everything from 10 Hz on.

    Parameters
    ----------
    channel : names of the channels, with the coordinate `channel_unit`
    samples : number of samples of the recording, a channel
    rate_hz : sample rate
    offsets : means of all samples, by position of the channels of vibration
    """

    def __init__(
        self, channel: xr.DataArray, samples: int, rate_hz: float, offsets: Mapping[int, float]
    ) -> None:
        self._channel, self._length_s = channel, samples / rate_hz
        self.edge_hz = float(np.clip(RINGING / MOST_OMITTED / self._length_s, *EDGES_HZ))
        self._band_hz = (LOWEST_HZ, min(HIGHEST_HZ, HIGHEST_SHARE * rate_hz))
        units = channel["channel_unit"].values
        has_band = self._band_hz[1] > LOWEST_HZ
        self._meters = {
            row: [
                Integrator(rate_hz, samples, DERIVATIVES[units[row]], self._band_hz, edge, offset)
                for edge in (self.edge_hz, BLOCK_EDGE_HZ)
            ]
            for row, offset in offsets.items()
            if has_band
        }

    def add(self, block: Array) -> None:
        """Take the next samples, shape (channel, time)."""
        for row, meters in self._meters.items():
            for meter in meters:
                meter.add(block[row])

    def result(self, middle_s: Array | None = None, duration_s: Array | None = None) -> xr.Dataset:
        """Return `velocity_rms` (channel), with that of blocks and their displacement if given.

        Not a number where a channel is no vibration, and at ends where the filter has not settled;
        empty without vibration. Attributes: band, and width of its edges.

        Parameters
        ----------
        middle_s : centre of each block, shape (block,), s
        duration_s : duration of the blocks, shape (block,), s
        """
        if not self._meters:
            return xr.Dataset()
        blocks = np.zeros(0) if middle_s is None else middle_s
        overall = np.full(self._channel.size, np.nan)
        by_block = np.full((2, self._channel.size, blocks.size), np.nan)
        for row, (sharp, quick) in self._meters.items():
            overall[row] = np.sqrt(self._mean_square(sharp))
            if middle_s is not None and duration_s is not None:
                by_block[:, row] = self._over_blocks(quick, middle_s, duration_s)
        results = xr.Dataset(
            {"velocity_rms": stamp("velocity_rms", overall, {"channel": self._channel})},
            attrs={
                "velocity_band_hz": list(self._band_hz),
                "velocity_edge_hz": self.edge_hz,
                "velocity_omitted_s": self._omitted_s(self.edge_hz),
            },
        )
        if middle_s is None:
            return results
        coords = {"channel": self._channel, "block": np.arange(blocks.size)}
        for name, values in zip(
            ("block_velocity_rms", "block_displacement"), by_block, strict=True
        ):
            results[name] = stamp(name, values, coords)
        return results

    def _omitted_s(self, edge_hz: float) -> float:
        """Length at either end in which the filter has not settled."""
        return min(RINGING / edge_hz, MOST_OMITTED * self._length_s)

    def _mean_square(self, meter: Integrator) -> float:
        energy, _ = meter.result()
        omitted_s = self._omitted_s(self.edge_hz)
        first = int(np.ceil(omitted_s / meter.tick_s))
        last = max(int((self._length_s - omitted_s) / meter.tick_s), first + 1)
        kept = energy[first:last]
        return float(kept.sum() / (kept.size * meter.tick_s))

    def _over_blocks(self, meter: Integrator, middle_s: Array, duration_s: Array) -> Array:
        """RMS velocity and range of the displacement of each block, shape (2, block)."""
        energy, extremes = meter.result()
        omitted_s = min(0.5 * self._omitted_s(BLOCK_EDGE_HZ), 0.125 * self._length_s)
        ticks = np.array(
            [np.ceil(omitted_s / meter.tick_s), (self._length_s - omitted_s) // meter.tick_s]
        )
        first_s, last_s = (ticks * meter.tick_s).tolist()
        square = windowed_mean_square(energy, meter.tick_s, (first_s, last_s), middle_s, duration_s)
        ranges = np.full(middle_s.size, np.nan)
        for number in np.flatnonzero(np.isfinite(square)):
            begin_s = max(middle_s[number] - 0.5 * duration_s[number], first_s)
            end_s = min(middle_s[number] + 0.5 * duration_s[number], last_s)
            first = int(begin_s / meter.tick_s)
            part = extremes[:, first : max(int(np.ceil(end_s / meter.tick_s)), first + 1)]
            ranges[number] = part[1].max() - part[0].min()
        return np.array([np.sqrt(square), ranges])
