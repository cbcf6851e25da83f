"""Orders against limits: of a recording, of a study, or of two results that are compared."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION, check, label_coordinates, stamp
from .figure_limit import EVERY_CHANNEL, Limit
from .order_comparison import ORDER_TOLERANCE, channel_orders, channel_units, listed
from .provenance import software_attributes

ORDERS: Final = ("channel", "speed", "order")
_CHECKED: Final = {
    "channel_order_rms": ("limit_margin", "within_limit"),
    "compared_order_rms": ("compared_limit_margin", "compared_within_limit"),
}
"""Margin and verdict by the RMS that they are of."""
NOT_CHECKED: Final = "limits_not_checked"
"""Attribute that lists limits of orders or speeds that the results do not have."""


def check_limits(
    results: xr.Dataset, limits: Sequence[Limit], option: str = REFERENCE_OPTION
) -> xr.Dataset:
    """Hold the RMS of every order against its limit.

    For a recording that is the RMS in the order's band, for a study the peak over √2. Where several
    limits hold for an order, the lowest counts.

    Parameters
    ----------
    results : result of `analyse_orders`, `run` or `compare`; of the latter both results are
        checked, against limits of either one's channel, at the speeds of the first
    limits : limits from `read_limits`, or made as `Limit`
    option : the balancing option of a study

    Returns
    -------
    `channel_order_rms` and its `order_limit` (unit in `channel_unit`), `limit_margin` (dB, above 0
    below the limit) and `within_limit` (true also where there is no limit), each
    (channel, speed, order); limit and margin are not a number where no limit holds. Of compared
    results also `compared_order_rms`, `compared_limit_margin`, `compared_within_limit`.
    `results.assign(checked.data_vars)` takes them in, and its figures then show the limits.

    Raises
    ------
    ParameterError
        A limit is for a channel that is not there or has another unit, no limit holds for any
        order, or the results hold no orders.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> checked = va.check_limits(orders, [va.Limit("ring", 1.0, 1.0, "m/s²")])
    >>> checked["limit_margin"].sel(channel="ring", order=1.0).isel(speed=0).round(1).item()
    3.0
    >>> bool(checked["within_limit"].all())
    True
    """
    values = _values(results, option)
    allowed, not_checked = _allowed(values, limits)
    checked = {"order_limit": stamp("order_limit", allowed, _coordinates(values))}
    for name, (margin, within) in _CHECKED.items():
        if name in values:
            with np.errstate(invalid="ignore"):  # without a limit
                below = -level_of_amplitude(values[name].values / allowed)
            checked[margin] = stamp(margin, below, _coordinates(values))
            checked[within] = stamp(within, ~(below < 0.0), _coordinates(values))
    kept = ("title", "first", "second", "option")
    attrs = {name: results.attrs[name] for name in kept if name in results.attrs}
    attrs |= software_attributes(f"limits of {attrs.get('title', 'results')}")
    labelled = values.assign(checked).assign_attrs(attrs, **{NOT_CHECKED: "; ".join(not_checked)})
    return check(label_coordinates(labelled))


def with_limits(results: xr.Dataset, limits: Sequence[Limit]) -> xr.Dataset:
    """Orders or compared orders that hold, besides, what `check_limits` gives of limits."""
    if not limits:
        return results
    checked = check_limits(results, limits)
    added = results.assign(checked.drop_vars(_CHECKED, errors="ignore").data_vars)
    return added.assign_attrs({NOT_CHECKED: checked.attrs[NOT_CHECKED]})


def _values(results: xr.Dataset, option: str) -> xr.Dataset:
    """RMS of every order, as `channel_order_rms`, in results with `channel_unit`."""
    if "order_difference" in results:
        missing = [name for name in _CHECKED if name not in results]
        if missing:
            raise ParameterError("compared orders: hold no RMS; compare the two results again")
        return results[list(_CHECKED)]
    if "channel_order_rms" in results:
        return results[["channel_order_rms"]].drop_vars(
            ["block_count", "calibration_factor"], errors="ignore"
        )
    peaks = channel_orders(results, option)
    coordinates = {**_coordinates(peaks.to_dataset()), "channel_unit": peaks["channel_unit"]}
    rms = np.abs(peaks.transpose(*ORDERS).values) / np.sqrt(2.0)
    return xr.Dataset({"channel_order_rms": stamp("channel_order_rms", rms, coordinates)})


def _coordinates(values: xr.Dataset) -> dict[str, Any]:
    return {name: values[name].values for name in ORDERS}


def _allowed(values: xr.Dataset, limits: Sequence[Limit]) -> tuple[Array, list[str]]:
    """Lowest limit (channel, speed, order), and the limits that hold for no order."""
    lowest = np.full([values.sizes[name] for name in ORDERS], np.inf)
    not_checked = []
    for limit in limits:
        holds = _holds(values, limit)
        if not holds.any():
            not_checked.append(f"{limit.origin} ({_subject(limit)})")
        lowest[holds] = np.minimum(lowest[holds], limit.rms)
    if np.isinf(lowest).all():
        orders = ", ".join(f"{order:g}" for order in values["order"].values)
        speed = values["speed"].values
        raise ParameterError(
            f"no limit is for these orders: {'; '.join(not_checked) or 'there is none'}; the "
            f"results have orders {orders} from {speed.min():.0f} to {speed.max():.0f} rpm"
        )
    return np.where(np.isinf(lowest), np.nan, lowest), not_checked


def _subject(limit: Limit) -> str:
    """Subject of a limit, such as `order 2 of ring from 0 to 3600 rpm`."""
    named = f"order {limit.order:g} of {limit.channel}"
    if limit.speed_from_rpm == 0.0 and np.isinf(limit.speed_to_rpm):
        return named
    return f"{named} from {limit.speed_from_rpm:g} to {limit.speed_to_rpm:g} rpm"


def _holds(values: xr.Dataset, limit: Limit) -> NDArray[np.bool_]:
    """Points at which a limit holds (channel, speed, order)."""
    speed, order = np.rint(values["speed"].values), values["order"].values  # measured: 2899.99
    at_speed = (speed >= limit.speed_from_rpm) & (speed <= limit.speed_to_rpm)
    at_order = np.abs(order - limit.order) < ORDER_TOLERANCE
    channels = _channels(values, limit)
    return np.asarray(channels[:, None, None] & at_speed[:, None] & at_order)


def _channels(values: xr.Dataset, limit: Limit) -> NDArray[np.bool_]:
    """The channels that a limit is for, each of its unit."""
    units = channel_units(values)
    fits = np.array([unit == limit.channel_unit for unit in units.values()])
    if limit.channel == EVERY_CHANNEL:
        named = fits
    else:
        names = [values[name].values for name in ("channel", "compared_channel") if name in values]
        named = np.any([of_one == limit.channel for of_one in names], axis=0)
    if not named.any():
        raise ParameterError(
            f"{limit.origin}: channel = {limit.channel!r}, in {limit.unit}: must be one of "
            f"{listed(units)}"
        )
    for unit in np.array(list(units.values()))[named & ~fits]:
        raise ParameterError(
            f"{limit.origin}: unit = {limit.unit!r}: channel {limit.channel!r} is in {unit}; "
            f"must be {'dB (re 20 µPa) or ' if unit == 'Pa' else ''}a unit of the same quantity"
        )
    return named
