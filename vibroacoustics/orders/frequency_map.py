"""Spectra of blocks of time with the speed: rpm-frequency maps, labelled for all channels."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from ..base.allowed import check_range
from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from .angular import check_finite
from .angular_plan import known_samples
from .block_spectra import block_spectra, block_starts
from .crank_motion import CrankMotion
from .windows import window_by_name

LEAST_SAMPLES: Final = 8
"""Least number of samples of a block."""


@dataclass(frozen=True)
class FrequencyMap:
    """Spectra of blocks of equal duration, labelled with the speed."""

    amplitude: ComplexArray
    """Complex peak against time zero, shape (..., block, frequency)."""
    frequency_hz: Array
    """Shape (frequency,)."""
    resolution_hz: float
    """Noise bandwidth of a line: the resolution really obtained."""
    time_s: Array
    """Middle of the blocks, shape (block,)."""
    shaft_frequency_hz: Array
    """Mean over each block, shape (block,)."""


def frequency_map(
    signal: Array,
    sample_rate_hz: float,
    motion: CrankMotion,
    resolution_hz: float,
    window: str = "hann",
    overlap_ratio: float = 0.5,
) -> FrequencyMap:
    """Spectra over time, each labelled with the mean speed of its block (rpm-frequency map).

    Parameters
    ----------
    signal : shape (..., time), uniformly sampled; sample 0 is at time zero
    sample_rate_hz : its sample rate
    motion : crank angle over (a part of) that time; only blocks within it are taken
    resolution_hz : coarsest noise bandwidth of a line
    window : rectangular, hann or flat_top
    overlap_ratio : share of a block that the next one covers too, from 0 to below 1

    Raises
    ------
    ParameterError
        The resolution is finer than the signal allows or coarser than blocks of eight samples, a
        value is outside its range, or a sample is not finite.
    """
    shape = window_by_name(window)
    check_finite(signal)
    first, end = known_samples(motion, sample_rate_hz, signal.shape[-1])
    line_hz = shape.noise_bandwidth_lines * sample_rate_hz
    limits_hz = line_hz / (end - first), line_hz / LEAST_SAMPLES
    check_range("resolution_hz", resolution_hz, *limits_hz, "Hz")
    needed = min(np.ceil(line_hz / resolution_hz), end - first)
    length = int(needed)
    starts = first + block_starts(end - first, length, overlap_ratio)
    lines = (length + 1) // 2
    start_s, end_s = starts / sample_rate_hz, (starts + length - 1) / sample_rate_hz
    turned = (motion.angle_rad(end_s) - motion.angle_rad(start_s)) / (2.0 * np.pi)
    return FrequencyMap(
        amplitude=block_spectra(signal, starts, starts, shape.samples(length), lines),
        frequency_hz=np.arange(lines, dtype=float) * (sample_rate_hz / length),
        resolution_hz=shape.noise_bandwidth_lines * sample_rate_hz / length,
        time_s=(start_s + end_s) / 2.0,
        shaft_frequency_hz=turned / (end_s - start_s),
    )


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
