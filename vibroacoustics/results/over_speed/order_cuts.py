"""Order cuts: shaft orders over the speed, of a study, a recording or a comparison."""

from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import amplitude_of_level, level_of_amplitude
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import WEIGHTING
from ..order_comparison import channel_orders
from ..stored_study import catalogue_receiver
from ..titles import chosen

MOST_ORDERS: Final = 8
"""Largest number for a study; a recording has those of its analysis."""
_QUIETEST: Final = 1e-4
"""Orders that stay below this share of the strongest, 80 dB, are none of them."""


class OrderCuts(NamedTuple):
    """Orders of a channel over the speed.

    Attributes
    ----------
    channel, unit : channel and its unit
    speed_rpm : rising, shape (point,)
    order : shape (order,)
    rms : RMS of one result or of two that are compared, shape (result, order, point)
    limits : RMS, shape (order, point); none where there are none
    """

    channel: str
    unit: str
    speed_rpm: Array
    order: Array
    rms: Array
    limits: Array | None = None

    def shown(self, rms: Array) -> Array:
        """Return sound pressure as level, dB re 20 µPa, and other units as they are."""
        if self.unit != "Pa":
            return rms
        positive = np.where(rms > 0.0, rms, np.nan)
        return np.asarray(level_of_amplitude(positive / REFERENCE_PRESSURE_PA))


def order_cuts(
    orders: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> OrderCuts:
    """Orders of a channel.

    Parameters
    ----------
    orders : result of `run`, `analyse_orders` or `compare`
    channel : channel, see `compare`; default: of a study the microphone of its published level,
        else the first
    option : option of a study
    """
    if "block_order_rms" in orders:
        return _of_recording(orders, channel)
    if "compared_order_rms" in orders:
        return _of_comparison(orders, channel)
    return _of_study(orders, channel, option)


def _of_recording(orders: xr.Dataset, channel: str | None) -> OrderCuts:
    of_channel = orders.sel(channel=chosen(orders, "channel", channel)).sortby("block_speed")
    limits = None
    if "order_limit" in of_channel and of_channel["order_limit"].count():
        off = np.abs(of_channel["block_speed"].values[:, None] - of_channel["speed"].values)
        nearest = of_channel["order_limit"].isel(speed=off.argmin(axis=1))
        limits = nearest.transpose("order", "speed").values
    rms = of_channel["block_order_rms"].transpose("order", "block").values
    return OrderCuts(
        str(of_channel["channel"].item()), str(of_channel["channel_unit"].item()),
        of_channel["block_speed"].values, of_channel["order"].values, rms[None], limits,
    )  # fmt: skip


def _of_comparison(compared: xr.Dataset, channel: str | None) -> OrderCuts:
    of_channel = compared.sel(channel=chosen(compared, "channel", channel)).sortby("speed")
    sides = [of_channel[f"{side}_order_rms"].transpose("order", "speed") for side in
            ("channel", "compared")]  # fmt: skip
    is_compared = np.isfinite(of_channel["order_difference"])
    rms = np.stack([side.where(is_compared).values for side in sides])
    return _cuts(of_channel, rms)


def _of_study(results: xr.Dataset, channel: str | None, option: str) -> OrderCuts:
    every = channel_orders(results, chosen(results, "option", option))
    name = channel or f"pressure {catalogue_receiver(results)}"
    of_channel = every.sel(channel=chosen(every.to_dataset(name="orders"), "channel", name))
    of_channel = of_channel.sortby("speed").transpose("order", "speed")
    return _cuts(of_channel, np.abs(of_channel.values)[None] / np.sqrt(2.0))


def _cuts(of_channel: xr.Dataset | xr.DataArray, rms: Array) -> OrderCuts:
    """The strongest orders of a channel."""
    order, speed = of_channel["order"].values, of_channel["speed"].values
    unit = str(of_channel["channel_unit"].item())
    rows = _strongest(np.nan_to_num(rms).max(axis=0), order, speed, unit)
    return OrderCuts(str(of_channel["channel"].item()), unit, speed, order[rows], rms[:, rows])


def _strongest(rms: Array, order: Array, speed_rpm: Array, unit: str) -> Array:
    """Rows of the strongest orders anywhere, of sound after weighting by A; none is order 0."""
    size = np.array(rms)
    if unit == "Pa":
        size *= amplitude_of_level(WEIGHTING["A"](order[:, None] * speed_rpm / 60.0))
    largest = np.where(order > 0.0, size.max(axis=1), 0.0)
    ranked = np.argsort(-largest, kind="stable")[:MOST_ORDERS]
    return np.sort(ranked[largest[ranked] > _QUIETEST * largest.max(initial=0.0)])
