"""The sound of one channel of a run-up, apart into its loudest orders and the residual."""

from fractions import Fraction
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed
import xarray as xr
from scipy.interpolate import CubicSpline

from ..base.arrays import Array
from ..base.errors import ParameterError, VibroacousticsError
from ..base.recording_blocks import RecordingBlocks
from ..orders.analysed import analysed_channels
from ..orders.crank_motion import CrankMotion
from ..orders.recorded_speed import recorded_speed
from ..orders.vold_kalman import Track, TrackedOrders, vold_kalman
from ..recordings import LabelledBlocks
from ..results import provenance
from ..results.over_speed.loudest_orders import loudest_orders
from ..results.over_speed.run_up_sound import RunUpSound, shown_channel
from ..study.order_analysis import OrderAnalysis

PLAYED_RATE_HZ: Final = 16000
"""Sample rate of the sound of faster recordings."""
_LOWEST_RATE_HZ: Final = 8e3
"""Lowest rate that browsers play; a lower one is multiplied."""
_LARGEST_FACTOR: Final = 500
"""Whole numbers whose ratio is that of two rates; other rates are divided by a whole number."""
LONGEST_S: Final = 120.0
_POLES: Final = 2


def check_listen(
    recording: xr.Dataset | RecordingBlocks, settings: OrderAnalysis, channel: str | None
) -> None:
    """Refuse a channel that is not analysed, before the analysis.

    Raises
    ------
    ParameterError
        There is no such channel besides those of the speed.
    """
    blocks = LabelledBlocks(recording) if isinstance(recording, xr.Dataset) else recording
    names = analysed_channels(blocks.channels, settings.speed)
    if channel is not None and channel not in names:
        with provenance.naming(blocks.attributes):
            raise ParameterError(f"listen = {channel}: must be one of {', '.join(names)}")


def listened(
    recording: xr.Dataset | RecordingBlocks,
    settings: OrderAnalysis,
    orders: xr.Dataset,
    channel: str | None = None,
    motion: CrankMotion | None = None,
) -> RunUpSound | None:
    """Sound of a channel with its loudest orders; None where there is no map of a run-up.

    Without a channel it is that of the first channel of sound pressure, and None where there is
    none, or where its orders cannot be separated.

    Parameters
    ----------
    recording, settings, orders, channel, motion : see `run_up_sound`

    Raises
    ------
    ParameterError, SolverError
        See `run_up_sound`; or there is no such channel.
    """
    name = shown_channel(orders, channel)
    is_pressure = orders["channel_unit"].sel(channel=name).item() == "Pa"
    if "order_map" not in orders or orders.sizes["speed"] < 2 or not (channel or is_pressure):
        return None
    wanted = loudest_orders(orders, name).order
    try:
        return run_up_sound(recording, settings, orders, name, wanted, motion)
    except VibroacousticsError:
        if channel:
            raise
        return None


def run_up_sound(
    recording: xr.Dataset | RecordingBlocks,
    settings: OrderAnalysis,
    orders: xr.Dataset,
    channel: str,
    wanted: Array,
    motion: CrankMotion | None = None,
) -> RunUpSound:
    """Separate orders of a channel from the residual with a Vold-Kalman filter.

    Its bandwidth is the resolution of the order analysis at the lowest speed, so that an order is
    as loud as its cut. The residual is the decimated signal, without its mean, less the orders.

    Parameters
    ----------
    recording : that was analysed, see `analyse_orders`
    settings : settings of the analysis
    orders : results of the analysis
    channel : one of its channels
    wanted : orders, shape (order,)
    motion : motion of the shaft, where it is known already; None to find it by the settings

    Raises
    ------
    ParameterError
        The recording is too long.
    SolverError
        Two orders are too close for too long.
    """
    blocks = LabelledBlocks(recording) if isinstance(recording, xr.Dataset) else recording
    duration_s = blocks.samples / blocks.sample_rate_hz
    if duration_s > LONGEST_S:
        raise ParameterError(
            f"listen = {channel}: {duration_s:.4g} s are too long, at most {LONGEST_S:g} s: "
            "choose a part by from_s and to_s"
        )
    motion = motion or recorded_speed(blocks, settings.speed).motion
    unit = blocks.channel_units[blocks.channels.index(channel)]
    signal = blocks.read([channel], 0, blocks.samples)[0]
    signal, rate_hz = played(signal - signal.mean(), blocks.sample_rate_hz)
    lowest_hz = float(orders["block_speed"].min()) / 60.0
    bandwidth_hz = float(orders.attrs["resolution_order"]) * lowest_hz
    tracks = [Track(motion, float(order)) for order in wanted]
    tracked = vold_kalman(signal, rate_hz, tracks, bandwidth_hz, _POLES)
    first = round(float(tracked.time_s[0]) * rate_hz)
    last = min(round(float(tracked.time_s[-1]) * rate_hz), signal.size - 1)
    time_s = np.arange(first, last + 1) / rate_hz
    residual = signal[first : last + 1] - _sum_of(tracked, wanted, motion, time_s)
    return RunUpSound(
        channel, unit, float(time_s[0]), rate_hz, residual, wanted, tracked.sample_rate_hz,
        tracked.envelope, motion.frequency_hz(tracked.time_s),
    )  # fmt: skip


def played(signal: Array, sample_rate_hz: float) -> tuple[Array, float]:
    """Signal at a rate that a browser plays, and that rate, Hz.

    Parameters
    ----------
    signal : shape (sample,)
    sample_rate_hz : sample rate of the signal
    """
    up, down = max(int(np.ceil(_LOWEST_RATE_HZ / sample_rate_hz)), 1), 1
    if sample_rate_hz > PLAYED_RATE_HZ:
        ratio = Fraction(PLAYED_RATE_HZ / sample_rate_hz).limit_denominator(_LARGEST_FACTOR)
        is_exact = abs(ratio * sample_rate_hz / PLAYED_RATE_HZ - 1.0) < 1e-9
        divided = Fraction(1, int(sample_rate_hz / PLAYED_RATE_HZ))
        up, down = (ratio if is_exact else divided).as_integer_ratio()
    if up == down:
        return signal, sample_rate_hz
    resampled = scipy.signal.resample_poly(signal, up, down)
    return np.asarray(resampled), sample_rate_hz * up / down


def _sum_of(tracked: TrackedOrders, order: Array, motion: CrankMotion, time_s: Array) -> Array:
    """Sum of the orders at times, shape (sample,)."""
    angle_rad, total = motion.angle_rad(time_s), np.zeros(time_s.size)
    for number, envelope in zip(order, tracked.envelope, strict=True):
        peak = CubicSpline(tracked.time_s, envelope)(time_s)
        phase = number * angle_rad
        total += peak.real * np.cos(phase) - peak.imag * np.sin(phase)
    return total
