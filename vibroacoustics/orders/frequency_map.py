"""Spectra of blocks of time with the speed: rpm-frequency maps."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.allowed import check_range
from ..base.arrays import Array, ComplexArray
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
