"""Levels of the channels of a recording, labelled."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.vocabulary import WEIGHTINGS, stamp
from ..study.order_analysis import BandMethod
from .band_meter import BandMeter
from .bands import Band, bands_between, measurable_bands
from .level_meter import LevelMeter, MeterPlan
from .signal_levels import in_bands


def windowed_mean_square(
    tick_energy: Array,
    tick_s: float,
    measured_s: tuple[float, float],
    middle_s: Array,
    duration_s: Array,
) -> Array:
    """Mean square of blocks under a Hann window w: ∫ w² x² dt / ∫ w² dt.

    By Parseval's theorem it is the power of all lines of the windowed block, over the window's
    noise bandwidth (Heinzel, Rüdiger and Schilling 2002, equations 21 to 24). So the level of a
    block and its orders, under the same window, are comparable. Within a tick the power is taken
    as constant. What is not measured is omitted on both sides of the quotient; a block of which
    less than half the window is measured is not a number.

    Parameters
    ----------
    tick_energy : ∫ x² dt over each tick, as far as measured, shape (..., tick), unit² s
    tick_s : length of a tick, s
    measured_s : first and last time that is measured, s
    middle_s : centre of each block, shape (block,), s
    duration_s : length of the blocks, shape (block,), s

    Returns
    -------
    shape (..., block), unit²

    Examples
    --------
    >>> steady = np.full(100, 4.0 * 0.01)  # 2 Pa effective, for 1 s
    >>> windowed_mean_square(steady, 0.01, (0.0, 1.0), np.array([0.5]), np.array([0.2]))
    array([4.])
    """
    edges = np.clip(np.arange(tick_energy.shape[-1] + 1) * tick_s, *measured_s)
    length = np.diff(edges)
    power = tick_energy / np.where(length > 0.0, length, 1.0)
    mean = np.full((*tick_energy.shape[:-1], middle_s.size), np.nan)
    begin_s, end_s = middle_s - 0.5 * duration_s, middle_s + 0.5 * duration_s
    first = np.clip(np.searchsorted(edges, begin_s, "right") - 1, 0, length.size - 1)
    last = np.clip(np.searchsorted(edges, end_s, "left"), 1, length.size)
    for block in range(middle_s.size):
        some = slice(first[block], last[block])
        turns = (edges[first[block] : last[block] + 1] - begin_s[block]) / duration_s[block]
        weights = np.diff(_window_energy(turns))
        if weights.sum() >= 0.5:
            mean[..., block] = power[..., some] @ weights / weights.sum()
    return mean


def _window_energy(share: Array) -> Array:
    """Energy of a Hann window from its start to a share of its length, of 1 at its end.

    ∫ sin⁴(πu) du · 8/3 = u - 2 sin(2πu) / (3π) + sin(4πu) / (12π).
    """
    u = np.clip(share, 0.0, 1.0)
    swing = np.sin(2.0 * np.pi * u) * 2.0 / 3.0 - np.sin(4.0 * np.pi * u) / 12.0
    return np.asarray(u - swing / np.pi)


LOWEST_BAND_HZ: Final = 25.0
HIGHEST_BAND_HZ: Final = 20e3
_DETECTORS: Final = ("equivalent", "fast_maximum", "slow_maximum")


class PressureLevels:
    """Levels of the channels of sound pressure of a recording that comes in blocks.

    A recording without sound pressure has none; other channels have no reference. An offset is no
    sound and is taken off.

    Parameters
    ----------
    channel : names of the channels, with the coordinate `channel_unit`
    samples : number of samples of the recording, a channel
    rate_hz : sample rate
    offsets : means of all samples, by position of the channels of sound pressure
    method : method of the third octaves, see `band_levels`
    """

    def __init__(
        self,
        channel: xr.DataArray,
        samples: int,
        rate_hz: float,
        offsets: Mapping[int, float],
        method: BandMethod = "sums",
    ) -> None:
        self._channel, self._method = channel, method
        plan = MeterPlan(samples, rate_hz)
        bands = measurable_bands(bands_between(3, LOWEST_BAND_HZ, HIGHEST_BAND_HZ), rate_hz)
        self._bands = bands
        self._meters = {row: LevelMeter(plan, offset) for row, offset in offsets.items()}
        summed = offsets if method == "sums" else {}
        self._sums = {
            row: BandMeter(samples, rate_hz, bands, offset) for row, offset in summed.items()
        }

    def add(self, block: Array) -> None:
        """Take the next samples, shape (channel, time)."""
        for row, meter in self._meters.items():
            meter.add(block[row])
        for row, sums in self._sums.items():
            sums.add(block[row])

    def result(self) -> xr.Dataset:
        """Return the levels of all samples added; attribute `levels_left_out_s`: see
        `labelled_levels`."""
        sums = {row: meter.mean_square() for row, meter in self._sums.items()}
        return labelled_levels(self._channel, self._meters, self._bands, self._method, sums)

    def over_blocks(self, middle_s: Array, duration_s: Array) -> xr.Dataset:
        """`block_level` (channel, block, weighting), of Hann-windowed blocks.

        It is not a number where a channel is no sound pressure, and where most of a block is in
        the part of the recording that the weighting omits. Empty without sound pressure.

        Parameters
        ----------
        middle_s : centre of each block, shape (block,), s
        duration_s : duration of the blocks, shape (block,), s
        """
        if not self._meters:
            return xr.Dataset()
        rows, plan = list(self._meters), next(iter(self._meters.values())).plan
        level = np.full((self._channel.size, middle_s.size, len(WEIGHTINGS)), np.nan)
        for column, name in enumerate(WEIGHTINGS):
            squares = np.array([meter.tick_squares[name] for meter in self._meters.values()])
            first, end = plan.measured(name)
            mean_square = windowed_mean_square(
                squares / plan.sample_rate_hz,
                plan.tick / plan.sample_rate_hz,
                (first / plan.sample_rate_hz, end / plan.sample_rate_hz),
                middle_s,
                duration_s,
            )
            is_finite = np.isfinite(mean_square)
            level_db = mean_square_level(
                np.where(is_finite, mean_square, 0.0), REFERENCE_PRESSURE_PA
            )
            level[rows, :, column] = np.where(is_finite, level_db, np.nan)
        coords = {
            "channel": self._channel,
            "block": np.arange(middle_s.size),
            "weighting": list(WEIGHTINGS),
        }
        return xr.Dataset({"block_level": stamp("block_level", level, coords)})


def labelled_levels(
    channel: xr.DataArray,
    meters: Mapping[int, LevelMeter],
    bands: Sequence[Band],
    method: BandMethod,
    unweighted: Mapping[int, Array],
) -> xr.Dataset:
    """Levels from the meters of the channels of sound pressure; empty where there are none.

    Attribute `levels_left_out_s`: what A- and C-weighted levels omit at either end.

    Parameters
    ----------
    channel : names of all channels
    meters : by position of the channel
    bands : third octaves
    method : see `band_levels`
    unweighted : mean squares (band,) by position of the channel, Pa², instead of those from the
        lines of its meter
    """
    if not meters:
        return xr.Dataset()
    shape, rows = (channel.size, len(WEIGHTINGS)), list(meters)
    broadband = np.full((*shape, len(_DETECTORS)), np.nan)
    by_band = np.full((*shape, len(bands)), np.nan)
    for column, weighting in enumerate(WEIGHTINGS):
        squares = np.array([meter.mean_square(weighting) for meter in meters.values()])
        broadband[rows, column] = mean_square_level(squares, REFERENCE_PRESSURE_PA)
        if weighting == "Z" and unweighted:
            squares = np.array([unweighted[row] for row in rows])
        else:
            squares = in_bands(list(meters.values()), bands, weighting, method)
        by_band[rows, column] = mean_square_level(squares, REFERENCE_PRESSURE_PA)
    coords = {"channel": channel, "weighting": list(WEIGHTINGS)}
    labelled = {
        f"{name}_level": stamp(f"{name}_level", broadband[..., detector], coords)
        for detector, name in enumerate(_DETECTORS)
    }
    by_name = {**coords, "band": [band.nominal_hz for band in bands]}
    return xr.Dataset(
        {**labelled, "band_level": stamp("band_level", by_band, by_name)},
        attrs={"levels_left_out_s": meters[rows[0]].plan.run_in_s, "band_method": method},
    )
