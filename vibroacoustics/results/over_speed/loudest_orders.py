"""Overall level and loudest orders of a recorded run-up over its speed."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power
from ...orders.loud_lines import a_weighted_power, ranked_orders
from ..titles import chosen

__all__ = ["LoudestOrders", "a_weighted_power", "loudest_orders"]


class LoudestOrders(NamedTuple):
    """Levels of a channel over the speed.

    Attributes
    ----------
    channel, unit : channel and its unit
    speed_rpm : speed of the blocks, rising, shape (block,)
    order : loudest orders, rising, shape (order,)
    level_db : in the orders' bands, shape (order, block); of sound pressure A-weighted at the
        orders' frequencies, dB re 20 µPa; of others dB re 1 unit, root mean square
    overall_db : level of all frequencies, A-weighted, shape (block,); none where it is no sound
        pressure
    """

    channel: str
    unit: str
    speed_rpm: Array
    order: Array
    level_db: Array
    overall_db: Array | None

    @property
    def reference(self) -> str:
        """Words for unit and reference of the levels."""
        return "dB(A)" if self.unit == "Pa" else f"dB re 1 {self.unit}"


def loudest_orders(
    orders: xr.Dataset, channel: str | None = None, gain: Array | None = None
) -> LoudestOrders:
    """Overall level and loudest orders of a channel over the speed.

    Candidates are the orders of the analysis and those that stand out in the map; ranked by their
    greatest level, at most six and 30 dB are kept.

    Parameters
    ----------
    orders : result of `analyse_orders`; needs `order_map` and, of sound pressure, `block_level`
    channel : one of the dataset's channels; default: the first
    gain : `a_weighted_power` of the map, if it is known
    """
    of_channel = orders.sel(channel=chosen(orders, "channel", channel))
    unit, band_order = str(of_channel["channel_unit"].item()), float(orders.attrs["band_order"])
    map_order, speed_rpm = orders["map_order"].values, orders["block_speed"].values
    peak = of_channel["order_map"].transpose("block", "map_order").values
    power = 0.5 * (peak.real**2 + peak.imag**2) / _noise_bandwidth_lines(orders)
    weighting: Array = np.ones(1)
    if unit == "Pa":
        power /= REFERENCE_PRESSURE_PA**2
        weighting = a_weighted_power(map_order, speed_rpm) if gain is None else gain
    candidates, in_bands, ranked = ranked_orders(
        power, map_order, orders["order"].values, band_order, weighting
    )
    rows = np.sort(ranked)
    level_db = level_of_power(in_bands).T
    rising = np.argsort(speed_rpm, kind="stable")
    overall_db = None
    if unit == "Pa" and "block_level" in of_channel:
        overall_db = of_channel["block_level"].sel(weighting="A").values[rising]
    return LoudestOrders(
        str(of_channel["channel"].item()), unit, speed_rpm[rising], candidates[rows],
        level_db[rows][:, rising], overall_db,
    )  # fmt: skip


def _noise_bandwidth_lines(orders: xr.Dataset) -> float:
    return float(orders.attrs["resolution_order"] * orders.attrs["revolutions_per_block"])
