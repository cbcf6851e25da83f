"""Loudest channel and order of a recording, which its page begins with."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power
from .loudest_orders import LoudestOrders, a_weighted_power


class LoudestChannel(NamedTuple):
    """Channel with the highest level, and its loudest order.

    Attributes
    ----------
    curves : curves of the channel
    overall_db, overall_rpm : greatest overall level and its speed; None where it has none
    order, order_db, order_rpm : loudest order, its greatest level and the speed of that
    channels : number of channels with the same unit
    quietest_db : smallest of the greatest overall levels of these channels; None without
    """

    curves: LoudestOrders
    overall_db: float | None
    overall_rpm: float
    order: float
    order_db: float
    order_rpm: float
    channels: int
    quietest_db: float | None


def orders_at_speeds(results: xr.Dataset) -> list[LoudestOrders]:
    """Levels of the orders of every channel at the operating points.

    Overall is the equivalent level, A-weighted, where the speed is one operating point.

    Parameters
    ----------
    results : result of `analyse_orders`
    """
    speed_rpm, order = results["speed"].values, results["order"].values
    gain = a_weighted_power(order, speed_rpm)
    curves = []
    for name, unit in zip(results["channel"].values, results["channel_unit"].values, strict=True):
        rms = results["channel_order_rms"].sel(channel=name).transpose("speed", "order").values
        power, overall_db = rms**2, None
        if unit == "Pa":
            power = power / REFERENCE_PRESSURE_PA**2 * gain
            if "equivalent_level" in results and speed_rpm.size == 1:
                level = results["equivalent_level"].sel(channel=name, weighting="A")
                overall_db = np.array([level.item()])
        level_db = level_of_power(power).T
        curves.append(LoudestOrders(str(name), str(unit), speed_rpm, order, level_db, overall_db))
    return curves


def loudest_channel(curves: Sequence[LoudestOrders]) -> LoudestChannel:
    """Channel of sound pressure with the highest overall level, else that with the largest order.

    Without sound pressure the channels with the unit of the first one are compared.

    Parameters
    ----------
    curves : curves of all channels, at least one
    """
    units = [each.unit for each in curves]
    unit = "Pa" if "Pa" in units else units[0]
    alike = [each for each in curves if each.unit == unit]
    overall = np.array([_greatest(each.overall_db) for each in alike])
    has_overall = bool(np.all(np.isfinite(overall)))
    ranking = overall if has_overall else np.array([each.level_db.max() for each in alike])
    loudest = alike[int(np.argmax(ranking))]
    row, block = np.unravel_index(int(np.argmax(loudest.level_db)), loudest.level_db.shape)
    overall_rpm = np.nan
    if has_overall and loudest.overall_db is not None:
        overall_rpm = float(loudest.speed_rpm[np.nanargmax(loudest.overall_db)])
    return LoudestChannel(
        loudest,
        float(overall.max()) if has_overall else None,
        overall_rpm,
        float(loudest.order[row]),
        float(loudest.level_db[row, block]),
        float(loudest.speed_rpm[block]),
        len(alike),
        float(overall.min()) if has_overall else None,
    )


def _greatest(level_db: Array | None) -> float:
    """Greatest level; not a number without."""
    has_any = level_db is not None and bool(np.isfinite(level_db).any())
    return float(np.nanmax(level_db)) if has_any and level_db is not None else float("nan")
