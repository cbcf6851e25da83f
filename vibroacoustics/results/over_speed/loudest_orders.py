"""Overall level and loudest orders of a recorded run-up over its speed."""

from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power, power_of_level
from ...base.weighting import WEIGHTING
from ..titles import chosen

MOST_LOUDEST: Final = 6
_RANGE_DB: Final = 30.0
"""Orders whose greatest level is further below the loudest order are omitted."""
_PEAK_RATIO: Final = 4.0
"""Power of a line over the median of the lines around it, from which it is an order: 6 dB."""


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


def a_weighted_power(order: Array, speed_rpm: Array) -> Array:
    """Power gain of the A-weighting at orders and speeds, shape (block, line).

    Parameters
    ----------
    order : multiples of the shaft frequency, shape (line,); that of order 0 is 0
    speed_rpm : shape (block,)
    """
    frequency_hz = np.maximum(np.outer(speed_rpm / 60.0, order), 1e-3)
    return np.asarray(power_of_level(WEIGHTING["A"](frequency_hz)))


def band_power(power: Array, map_order: Array, order: Array, band_order: float) -> Array:
    """Sum of the powers of the lines in the bands of orders, shape (block, order).

    Parameters
    ----------
    power : power of the lines, shape (block, line)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    order : middles of the bands, shape (order,)
    band_order : width of the bands, orders
    """
    slack = 1e-6 * map_order[1]
    sums = np.concatenate([np.zeros((len(power), 1)), np.cumsum(power, axis=1)], axis=1)
    first = np.searchsorted(map_order, order - 0.5 * band_order - slack)
    end = np.searchsorted(map_order, order + 0.5 * band_order + slack)
    return np.asarray(sums[:, end] - sums[:, first])


def standing_out(mean_power: Array, map_order: Array, band_order: float) -> Array:
    """Orders whose line is a peak, 6 dB above the median of the lines around it, rising.

    The stronger of two peaks in one band counts.

    Parameters
    ----------
    mean_power : mean power of the lines, shape (line,)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    band_order : width of the bands, orders; the first and last half of it are omitted
    """
    reach = max(round(band_order / map_order[1]), 1)
    half = reach // 2 + 1
    lines_found: list[int] = []
    for line in np.argsort(-mean_power, kind="stable").tolist():
        if not half <= line < mean_power.size - half:
            continue
        around = mean_power[max(line - 2 * reach, half) : line + 2 * reach + 1]
        is_peak = mean_power[line] == mean_power[line - 1 : line + 2].max()
        is_clear = mean_power[line] > _PEAK_RATIO * np.median(around)
        if is_peak and is_clear and all(abs(line - other) > reach for other in lines_found):
            lines_found.append(line)
    return np.sort(map_order[lines_found])


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

    Raises
    ------
    ParameterError
        There is no such channel.
    """
    of_channel = orders.sel(channel=chosen(orders, "channel", channel))
    unit, band_order = str(of_channel["channel_unit"].item()), float(orders.attrs["band_order"])
    map_order, speed_rpm = orders["map_order"].values, orders["block_speed"].values
    peak = of_channel["order_map"].transpose("block", "map_order").values
    power = 0.5 * (peak.real**2 + peak.imag**2) / _noise_bandwidth_lines(orders)
    weighted = power
    if unit == "Pa":
        power /= REFERENCE_PRESSURE_PA**2
        weighted = power * (a_weighted_power(map_order, speed_rpm) if gain is None else gain)
    wanted = orders["order"].values
    others = standing_out(weighted.mean(axis=0), map_order, band_order)
    apart = np.abs(others[:, None] - wanted).min(axis=1, initial=np.inf) > band_order
    candidates = np.sort(np.concatenate([wanted, others[apart]]))
    in_bands = band_power(power, map_order, candidates, band_order)
    if unit == "Pa":
        in_bands = in_bands * a_weighted_power(candidates, speed_rpm)
    level_db = level_of_power(in_bands).T
    greatest = level_db.max(axis=1)
    ranked = np.argsort(-greatest, kind="stable")[:MOST_LOUDEST]
    rows = np.sort(ranked[greatest[ranked] > greatest.max() - _RANGE_DB])
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
