"""1× readings of a recording with a tacho, each with its standard deviation."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError
from ...orders.angular_stream import angular_resample
from ...orders.recorded_speed import check_speed_channels, recorded_speed
from ...recordings import LabelledBlocks, read_recording
from ...study.order_analysis import SpeedChannel
from ..campaign_settings import Campaign

MAXIMUM_ORDER: Final = 4.0
BLOCKS: Final = 20
"""Blocks of whole revolutions whose scatter is that of the mean."""
LEAST_BLOCKS: Final = 8


class MeanPhasor(NamedTuple):
    """Mean of the 1× phasors of blocks.

    Attributes
    ----------
    value : complex peak against crank angle zero, shape (channel,)
    deviation : standard deviation of the mean's real and imaginary part, shape (channel,)
    """

    value: ComplexArray
    deviation: Array


class RecordedReadings(NamedTuple):
    """Readings of a recording.

    Attributes
    ----------
    speed_rpm : mean speed
    values : complex peak by channel, SI
    deviations : standard deviation of real and imaginary part by channel, SI
    units : SI unit by channel
    """

    speed_rpm: float
    values: Mapping[str, complex]
    deviations: Mapping[str, float]
    units: Mapping[str, str]


def mean_phasor(signal: Array, per_revolution: int, first_sample: int = 0) -> MeanPhasor:
    """Find the 1× phasor of a signal over the crank angle: 2/N Σ x exp(-jθ) of whole revolutions.

    Parameters
    ----------
    signal : samples over the crank angle, shape (channel, sample)
    per_revolution : samples per revolution
    first_sample : number of the first sample from crank angle zero

    Raises
    ------
    ParameterError
        There are fewer than 8 revolutions.
    """
    revolutions = signal.shape[1] // per_revolution
    if revolutions < LEAST_BLOCKS:
        raise ParameterError(f"has {revolutions} revolutions: must be at least {LEAST_BLOCKS}")
    length = max(revolutions // BLOCKS, 1) * per_revolution
    count = signal.shape[1] // length
    angle = 2.0 * np.pi * (first_sample + np.arange(count * length)) / per_revolution
    turned = 2.0 * signal[:, : count * length] * np.exp(-1j * angle)
    phasors = turned.reshape(len(signal), count, length).mean(axis=-1)
    value = phasors.mean(axis=1)
    squares = np.sum(np.abs(phasors - value[:, None]) ** 2, axis=1)
    return MeanPhasor(value, np.sqrt(0.5 * squares / (count - 1) / count))


def recorded_readings(path: Path, campaign: Campaign) -> RecordedReadings:
    """Read the 1× readings of a recording; its tacho gives one pulse a revolution or an index.

    Raises
    ------
    ParameterError
        The speed has no mark on the shaft, a channel is missing, or there are too few revolutions.
    StorageError
        The file cannot be read.
    """
    speed = campaign.speed_of(path)
    if not isinstance(speed, SpeedChannel) or (
        speed.pulses_per_revolution > 1 and speed.index_channel is None
    ):
        raise ParameterError(
            f"{path}: speed: phases need a mark on the shaft: give the channel of a tacho with one "
            "pulse per revolution, or an index_channel"
        )
    recording = read_recording(path, **campaign.reading_of(path))
    try:
        return readings_of(recording, speed)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None


def readings_of(recording: xr.Dataset, speed: SpeedChannel) -> RecordedReadings:
    """Return the 1× readings of a recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    speed : channel of the tacho
    """
    names = [str(name) for name in recording["channel"].values]
    units = dict(zip(names, map(str, recording["channel_unit"].values), strict=True))
    check_speed_channels(names, speed)
    motion = recorded_speed(LabelledBlocks(recording), speed).motion
    measured = [name for name in names if name not in (speed.channel, speed.index_channel)]
    samples = recording["signal"].sel(channel=measured).values
    angular = angular_resample(samples, recording.attrs["sample_rate_hz"], motion, MAXIMUM_ORDER)
    mean = mean_phasor(angular.values, angular.samples_per_revolution, angular.first_sample)
    turned = float(np.ptp(motion.angle_rad(angular.time_s[[0, -1]]))) / (2.0 * np.pi)
    rpm = 60.0 * turned / float(np.ptp(angular.time_s[[0, -1]]))
    return RecordedReadings(
        rpm,
        dict(zip(measured, mean.value.tolist(), strict=True)),
        dict(zip(measured, mean.deviation.tolist(), strict=True)),
        units,
    )
