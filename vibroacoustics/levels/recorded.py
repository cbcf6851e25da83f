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
from .bands import Band, band_mean_square, bands_between, measurable_bands
from .level_meter import LevelMeter, MeterPlan
from .signal_levels import in_bands

LOWEST_BAND_HZ: Final = 25.0
HIGHEST_BAND_HZ: Final = 20e3
_DETECTORS: Final = ("equivalent", "fast_maximum", "slow_maximum")


def channel_levels(signal: xr.DataArray, rate_hz: float, method: BandMethod = "sums") -> xr.Dataset:
    """Levels of the channels of sound pressure; not a number for others, which have no reference.

    A recording without sound pressure has none. An offset is no sound and is taken off. Attribute
    `levels_left_out_s`: what A- and C-weighted levels leave out at either end.

    Parameters
    ----------
    signal : (channel, time), with the coordinate `channel_unit`
    rate_hz : sample rate
    method : of the third octaves, see `band_levels`
    """
    plan = MeterPlan(signal.sizes["time"], rate_hz)
    bands = measurable_bands(bands_between(3, LOWEST_BAND_HZ, HIGHEST_BAND_HZ), rate_hz)
    meters, sums = {}, {}
    for number in np.flatnonzero(signal["channel_unit"].values == "Pa"):
        samples = signal.values[number]
        meters[number] = LevelMeter(plan, float(np.mean(samples)))
        meters[number].add(samples)
        if method == "sums":  # of all of the recording at once: its lines lie closest
            sums[number] = band_mean_square(samples, rate_hz, bands)  # an offset is line 0 alone
    return labelled_levels(signal["channel"], meters, bands, method, sums)


def labelled_levels(
    channel: xr.DataArray,
    meters: Mapping[int, LevelMeter],
    bands: Sequence[Band],
    method: BandMethod,
    unweighted: Mapping[int, Array],
) -> xr.Dataset:
    """Levels from the meters of the channels of sound pressure; empty where there are none.

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
