"""Orders of all channels of a recording, tracked over time and labelled."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.allowed import check_range
from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from ..study.order_analysis import FIRST_ORDERS, ORDERS, default_orders
from .angular_plan import known_samples
from .crank_motion import CrankMotion
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
