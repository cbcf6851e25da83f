"""Results of a recording: orders and levels, tracked orders, a map over the speed."""

from collections.abc import Callable, Sequence
from functools import partial

import xarray as xr

from ..base.progress import Progress, no_progress
from ..base.recording_blocks import RecordingBlocks
from ..base.vocabulary import check, label_coordinates
from ..levels.block_levels import labelled_block_levels
from ..orders import recorded as of_recording
from ..orders.analysed import analysed_channels, channels_without_speed
from ..orders.analysis_defaults import with_defaults
from ..orders.crank_motion import CrankMotion
from ..orders.recorded_speed import recorded_speed
from ..orders.shaft_speed import RecordedSpeed
from ..orders.tracked import labelled_map, mapped_spectra, tracked_orders
from ..recordings import LabelledBlocks
from ..results import provenance
from ..study.order_analysis import OrderAnalysis, SpeedSource
from .block_pass import passed_over


def analyse_orders(
    recording: xr.Dataset | RecordingBlocks,
    settings: OrderAnalysis,
    progress: Progress = no_progress,
    speed: RecordedSpeed | None = None,
) -> xr.Dataset:
    """Orders and levels of every channel of a recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`; or from `open_recording`, of any length
    settings : where the speed comes from, and which orders are wanted
    progress : called with the advance
    speed : that the settings give, where `recorded_speed` has found it already

    Raises
    ------
    ParameterError, SolverError
        The speed cannot be found, or an order cannot be told at the resolution.

    Examples
    --------
    >>> time = np.arange(8192) / 1024.0
    >>> signal = 3.0 * np.cos(2.0 * np.pi * 50.0 * time)
    >>> recording = va.label_recording([signal], 1024.0, ["ring"], ["m/s²"])
    >>> settings = va.OrderAnalysis(va.NominalSpeed(3000.0), orders=(1.0,), maximum_order=4.0)
    >>> orders = va.analyse_orders(recording, settings)
    >>> abs(orders["channel_order"]).sel(channel="ring", order=1.0).round(3).values
    array([3.])
    """
    blocks = LabelledBlocks(recording) if isinstance(recording, xr.Dataset) else recording
    with provenance.naming(blocks.attributes):
        speed = speed or recorded_speed(blocks, settings.speed)
        settings = with_defaults(settings, blocks.sample_rate_hz, blocks.samples, speed.motion)
        names = analysed_channels(blocks.channels, settings.speed)
        passed = passed_over(blocks, names, speed.motion, settings, progress)
        results = passed.merge(of_recording.fault_times(speed.faults))
        results.attrs = {
            **provenance.recording_attributes(blocks.attributes, settings),
            **speed.attributes(),
            **passed.attrs,
        }
        return check(label_coordinates(results))


def track_orders(
    recording: xr.Dataset,
    speed: SpeedSource,
    orders: Sequence[float] | None,
    bandwidth_hz: float,
    poles: int = 2,
) -> xr.Dataset:
    """Complex envelope of each order over the time of a recording, all orders together.

    A Vold-Kalman filter of the second generation (Vold, Mains and Blough 1997, SAE 972007). It
    separates orders that lie close or cross, and follows them up to the ends of the recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    speed : where the speed comes from: `SpeedChannel`, `NominalSpeed` or `TacholessSpeed`
    orders : multiples of the shaft's speed that are tracked, whole or not; None for those of 1 to
        4 that the sample rate holds
    bandwidth_hz : full width at -3 dB of what passes around each order; below the distance of
        orders that stay side by side, and up to √s where two cross with s Hz/s
    poles : 1, 2 or 3; each steepens the filter by 40 dB a decade

    Returns
    -------
    `tracked_order` (channel, track_time, order), complex peak in the channel's unit, with
    `track_speed` (track_time), rpm; attribute `noise_gain`: the largest factor by which noise
    within the bandwidth grows because orders are close

    Raises
    ------
    ParameterError
        The speed cannot be found, or the bandwidth does not fit recording or orders.
    SolverError
        Two orders are too close for too long.

    Examples
    --------
    >>> time = np.arange(4096) / 1024.0
    >>> swelling = (1.0 + time) * np.cos(2.0 * np.pi * 50.0 * time)
    >>> recording = va.label_recording([swelling], 1024.0, ["ring"], ["m/s²"])
    >>> tracked = va.track_orders(recording, va.NominalSpeed(3000.0), [1.0], bandwidth_hz=2.0)
    >>> at_2_s = tracked["tracked_order"].sel(channel="ring", order=1.0).sel(
    ...     track_time=2.0, method="nearest")
    >>> round(abs(at_2_s.item()), 2)
    3.0
    """
    tracked = partial(tracked_orders, orders=orders, bandwidth_hz=bandwidth_hz, poles=poles)
    return _at_once(recording, speed, "tracked orders", tracked)


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

    def spectra(signal: xr.DataArray, rate_hz: float, motion: CrankMotion) -> xr.Dataset:
        mapped = mapped_spectra(signal, rate_hz, motion, resolution_hz)
        levels = labelled_block_levels(
            mapped.amplitude, mapped.frequency_hz, mapped.resolution_hz, signal["channel_unit"]
        )
        return labelled_map(mapped, signal, maximum_frequency_hz).merge(levels)

    return _at_once(recording, speed, "speed-frequency map", spectra)


def _at_once(
    recording: xr.Dataset,
    speed: SpeedSource,
    what: str,
    compute: Callable[[xr.DataArray, float, CrankMotion], xr.Dataset],
) -> xr.Dataset:
    """Results of all channels but those of the speed, with their provenance."""
    with provenance.naming(recording.attrs):
        of_shaft = recorded_speed(LabelledBlocks(recording), speed)
        signal = channels_without_speed(recording["signal"], speed)
        computed = compute(signal, float(recording.attrs["sample_rate_hz"]), of_shaft.motion)
        about = provenance.of_recording(recording.attrs, what)
        computed.attrs = {**about, **of_shaft.attributes(), **computed.attrs}
        return check(label_coordinates(computed))
