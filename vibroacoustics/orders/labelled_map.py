"""Spectra over speed and frequency of all channels of a recording, labelled."""

import numpy as np
import xarray as xr

from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from .crank_motion import CrankMotion
from .frequency_map import FrequencyMap, frequency_map


def mapped_spectra(
    signal: xr.DataArray, sample_rate_hz: float, motion: CrankMotion, resolution_hz: float
) -> FrequencyMap:
    """Spectra of blocks of a signal (channel, time) without its mean; see `frequency_map`."""
    values = signal.values - signal.values.mean(axis=-1, keepdims=True)
    return frequency_map(values, sample_rate_hz, motion, resolution_hz)


def labelled_map(
    mapped: FrequencyMap, signal: xr.DataArray, maximum_frequency_hz: float | None
) -> xr.Dataset:
    """`speed_frequency_map` (channel, block, map_frequency) with time and speed of the blocks.

    Parameters
    ----------
    mapped : map of the signal
    signal : (channel, time), with `channel_unit`
    maximum_frequency_hz : highest that is kept; None for all

    Raises
    ------
    ParameterError
        Not two frequencies would be left.
    """
    highest = mapped.frequency_hz[-1] if maximum_frequency_hz is None else maximum_frequency_hz
    kept = mapped.frequency_hz <= highest
    if np.count_nonzero(kept) < 2:
        raise ParameterError(
            f"maximum_frequency_hz = {highest:g} Hz: must be at least {mapped.frequency_hz[1]:g} Hz"
        )
    coords = {
        "channel": signal["channel"],
        "block": np.arange(mapped.time_s.size),
        "map_frequency": mapped.frequency_hz[kept],
    }
    return xr.Dataset(
        {"speed_frequency_map": stamp("speed_frequency_map", mapped.amplitude[..., kept], coords)},
        coords={
            "block_time": ("block", mapped.time_s),
            "block_speed": ("block", 60.0 * mapped.shaft_frequency_hz),
            "channel_unit": signal["channel_unit"],
        },
        attrs={"resolution_hz": mapped.resolution_hz, "window": "hann"},
    )
