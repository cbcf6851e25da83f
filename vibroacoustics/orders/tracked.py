"""Orders of all channels of a recording tracked over time, and maps over the speed, labelled."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.allowed import check_range
from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from ..study.order_analysis import FIRST_ORDERS, ORDERS, default_orders
from .angular_plan import known_samples
from .crank_motion import CrankMotion
from .frequency_map import FrequencyMap, frequency_map
from .vold_kalman import Track, vold_kalman


def tracked_orders(
    signal: xr.DataArray,
    sample_rate_hz: float,
    motion: CrankMotion,
    orders: Sequence[float] | None,
    bandwidth_hz: float,
    poles: int,
) -> xr.Dataset:
    """Complex envelope of each order, `tracked_order` (channel, track_time, order), complex peak.

    Parameters
    ----------
    signal : (channel, time)
    sample_rate_hz : sample rate of the signal
    motion : motion of the shaft
    orders : multiples of the shaft's speed; None for those of 1 to 4 that the sample rate holds
    bandwidth_hz, poles : see `vold_kalman`

    Raises
    ------
    ParameterError, SolverError
        See `vold_kalman`; or an order is named twice or out of range.
    """
    if orders is None:
        first, last = known_samples(motion, sample_rate_hz, signal.sizes["time"])
        fastest_hz = float(np.max(motion.frequency_hz(np.arange(first, last) / sample_rate_hz)))
        limit = (0.5 * sample_rate_hz - bandwidth_hz) / fastest_hz
        orders = default_orders(limit) or FIRST_ORDERS[:1]
    numbers = [float(order) for order in orders]
    for order in numbers:
        check_range("orders", order, *ORDERS)
    if not numbers or len(set(numbers)) < len(numbers):
        raise ParameterError(f"orders = {numbers}: must be at least one order, each once")
    tracks = [Track(motion, order) for order in numbers]
    tracked = vold_kalman(signal.values, sample_rate_hz, tracks, bandwidth_hz, poles)
    coords = {"channel": signal["channel"], "track_time": tracked.time_s, "order": numbers}
    rpm = 60.0 * motion.frequency_hz(tracked.time_s)
    return xr.Dataset(
        {"tracked_order": stamp("tracked_order", np.swapaxes(tracked.envelope, 1, 2), coords)},
        coords={"track_speed": ("track_time", rpm), "channel_unit": signal["channel_unit"]},
        attrs={"bandwidth_hz": bandwidth_hz, "poles": poles, "noise_gain": tracked.noise_gain},
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
