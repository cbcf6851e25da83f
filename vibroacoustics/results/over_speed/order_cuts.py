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
"""Of a study; a recording has those that were asked for."""
_QUIETEST: Final = 1e-4
"""Orders that stay below this share of the strongest, 80 dB, are none of them."""


class OrderCuts(NamedTuple):
    """Orders of a channel over the speed.

    Attributes
    ----------
    channel, unit : of what
    speed_rpm : rising, shape (point,)
    order : shape (order,)
    rms : of one result or of two that are compared, shape (result, order, point)
    limits : RMS, shape (order, point); none where there are none
    """

    channel: str
    unit: str
    speed_rpm: Array
    order: Array
    rms: Array
    limits: Array | None = None

    def shown(self, rms: Array) -> Array:
        """As drawn: of sound pressure the level, dB re 20 µPa, else itself."""
        if self.unit != "Pa":
            return rms
        known = np.where(rms > 0.0, rms, np.nan)
        return np.asarray(level_of_amplitude(known / REFERENCE_PRESSURE_PA))


def order_cuts(
    orders: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> OrderCuts:
    """Orders of a channel.

    Parameters
    ----------
    orders : of `run`, `analyse_orders` or `compare`
    channel : as in `compare`; default: of a study the microphone of its catalogue, else the first
    option : of a study

    Raises
    ------
    ParameterError
        There is no such channel or option.
    """
    if "block_order_rms" in orders:
        return _of_recording(orders, channel)
    if "compared_order_rms" in orders:
        return _of_comparison(orders, channel)
    return _of_study(orders, channel, option)


def _of_recording(orders: xr.Dataset, channel: str | None) -> OrderCuts:
    there = orders.sel(channel=chosen(orders, "channel", channel)).sortby("block_speed")
    limits = None
    if "order_limit" in there and there["order_limit"].count():
        of_speed = there["order_limit"].sel(speed=there["block_speed"], method="nearest")
        limits = of_speed.transpose("order", "block").values
    rms = there["block_order_rms"].transpose("order", "block").values
    return OrderCuts(
        str(there["channel"].item()), str(there["channel_unit"].item()),
        there["block_speed"].values, there["order"].values, rms[None], limits,
    )  # fmt: skip


def _of_comparison(compared: xr.Dataset, channel: str | None) -> OrderCuts:
    there = compared.sel(channel=chosen(compared, "channel", channel)).sortby("speed")
    both = [there[f"{side}_order_rms"].transpose("order", "speed") for side in
            ("channel", "compared")]  # fmt: skip
    rms = np.stack([one.where(np.isfinite(there["order_difference"])).values for one in both])
    return _cuts(there, rms)


def _of_study(results: xr.Dataset, channel: str | None, option: str) -> OrderCuts:
    every = channel_orders(results, chosen(results, "option", option))
    name = channel or f"pressure {catalogue_receiver(results)}"
    there = every.sel(channel=chosen(every.to_dataset(name="orders"), "channel", name))
    there = there.sortby("speed").transpose("order", "speed")
    return _cuts(there, np.abs(there.values)[None] / np.sqrt(2.0))


def _cuts(there: xr.Dataset | xr.DataArray, rms: Array) -> OrderCuts:
    """The strongest orders of a channel."""
    order, speed = there["order"].values, there["speed"].values
    unit = str(there["channel_unit"].item())
    rows = _strongest(np.nan_to_num(rms).max(axis=0), order, speed, unit)
    return OrderCuts(str(there["channel"].item()), unit, speed, order[rows], rms[:, rows])


def _strongest(rms: Array, order: Array, speed_rpm: Array, unit: str) -> Array:
    """Rows of the strongest orders anywhere, of sound after weighting by A; none is order 0."""
    size = np.array(rms)
    if unit == "Pa":
        size *= amplitude_of_level(WEIGHTING["A"](order[:, None] * speed_rpm / 60.0))
    largest = np.where(order > 0.0, size.max(axis=1), 0.0)
    ranked = np.argsort(-largest, kind="stable")[:MOST_ORDERS]
    return np.sort(ranked[largest[ranked] > _QUIETEST * largest.max(initial=0.0)])
