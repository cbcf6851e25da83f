"""Spectra of a recording over speed and frequency, and levels over the speed."""

import numpy as np
import xarray as xr

from .. import levels, orders
from ..base.arrays import Array
from ..base.errors import ParameterError, VibroacousticsError
from ..base.vocabulary import WEIGHTINGS, check, label_coordinates, stamp
from ..orders.recorded_speed import (
    RecordedSpeed,
    SpeedSource,
    channels_without_speed,
    recorded_speed,
)
from ..results import provenance


def speed_frequency_map(
    recording: xr.Dataset,
    speed: SpeedSource,
    resolution_hz: float,
    maximum_frequency_hz: float | None = None,
) -> xr.Dataset:
    """Spectra of blocks of a recording, each labelled with its speed: a Campbell map.

    Orders are straight lines through the origin on it, natural frequencies lines of constant
    frequency. Blocks have a Hann window and overlap by half; the recording's mean is taken off.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    speed : where the speed comes from: `SpeedChannel`, `NominalSpeed` or `TacholessSpeed`
    resolution_hz : coarsest noise bandwidth of a line
    maximum_frequency_hz : highest frequency that is kept; default: half the sample rate

    Returns
    -------
    `speed_frequency_map` (channel, block, map_frequency), complex peak in the channel's unit;
    where a channel is sound pressure `block_level` (channel, block, weighting), dB re 20 µPa, of
    all frequencies above 0 Hz; coordinates `block_speed`, rpm, and `block_time`, s

    Raises
    ------
    ParameterError
        The speed cannot be found, or the recording is too short for the resolution.

    Examples
    --------
    >>> time = np.arange(4096) / 1024.0
    >>> frequency = 20.0 + 10.0 * time  # of the shaft, Hz
    >>> tone = np.cos(2.0 * np.pi * (20.0 * time + 5.0 * time**2))
    >>> recording = va.label_recording(
    ...     [tone, 60.0 * frequency], 1024.0, ["front", "speed"], ["Pa", "rpm"])
    >>> mapped = va.speed_frequency_map(recording, va.SpeedChannel("speed"), resolution_hz=8.0)
    >>> mapped["speed_frequency_map"].dims
    ('channel', 'block', 'map_frequency')
    >>> mapped["block_level"].sel(channel="front", weighting="Z").mean().round(1).item()
    91.0
    """
    try:
        of_shaft = recorded_speed(recording, speed)
        signal = channels_without_speed(recording["signal"], speed)
        mapped = _mapped(signal, recording, of_shaft, resolution_hz)
        return _labelled(mapped, signal, recording, of_shaft, maximum_frequency_hz)
    except VibroacousticsError as error:
        raise type(error)(f"{provenance.recording_name(recording)}: {error}") from None


def _mapped(
    signal: xr.DataArray, recording: xr.Dataset, speed: RecordedSpeed, resolution_hz: float
) -> orders.FrequencyMap:
    values = signal.values - signal.values.mean(axis=-1, keepdims=True)
    rate_hz = float(recording.attrs["sample_rate_hz"])
    return orders.frequency_map(values, rate_hz, speed.motion, resolution_hz)


def _labelled(
    mapped: orders.FrequencyMap,
    signal: xr.DataArray,
    recording: xr.Dataset,
    speed: RecordedSpeed,
    maximum_frequency_hz: float | None,
) -> xr.Dataset:
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
    result = xr.Dataset(
        {"speed_frequency_map": stamp("speed_frequency_map", mapped.amplitude[..., kept], coords)},
        coords={
            "block_time": ("block", mapped.time_s),
            "block_speed": ("block", 60.0 * mapped.shaft_frequency_hz),
            "channel_unit": signal["channel_unit"],
        },
    )
    if (signal["channel_unit"] == "Pa").any():
        by_block = {"channel": coords["channel"], "block": coords["block"]}
        by_block["weighting"] = list(WEIGHTINGS)
        result["block_level"] = stamp("block_level", _levels(mapped, signal), by_block)
    result.attrs = {
        **provenance.of_recording(recording, "speed-frequency map"),
        **speed.attributes(),
        "resolution_hz": mapped.resolution_hz,
        "window": "hann",
    }
    return check(label_coordinates(result))


def _levels(mapped: orders.FrequencyMap, signal: xr.DataArray) -> Array:
    """Levels (channel, block, weighting); not a number where a channel is no sound pressure."""
    is_pressure = signal["channel_unit"].values == "Pa"
    result = np.full((is_pressure.size, mapped.time_s.size, len(WEIGHTINGS)), np.nan)
    for number, weighting in enumerate(WEIGHTINGS):
        result[is_pressure, :, number] = levels.block_levels(
            mapped.amplitude[is_pressure], mapped.frequency_hz, mapped.resolution_hz, weighting
        )
    return result
