"""Charts of a recording: order spectrum, orders over speed, order map, levels, tracked orders."""

from typing import Final

import numpy as np
import xarray as xr

from ...results.map_levels import map_level
from ...results.over_speed.level_curves import is_run_up
from ...results.titles import chosen
from ..charts.axes import amplitude_axis
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Image, Panel, Segments, lines
from ..charts.marks import Line as Curve
from ..charts.needs import needs
from ..file_names import numbered
from .levels_over_speed import levels_over_speed
from .orders_over_speed import orders_over_speed
from .speed_maps import speed_frequency_map

_MAP_RANGE_DB: Final = 60.0


def recorded_order_charts(results: xr.Dataset) -> list[Chart]:
    """Return for each channel: mean spectrum, orders over speed in a run-up, map if present."""
    charts = []
    for channel in map(str, results["channel"].values):
        charts.append(order_spectrum(results, channel))
        if _is_run_up(results):
            charts.append(orders_over_speed(results, channel))
        if "order_map" in results:
            charts.append(order_map(results, channel))
    return charts


def _is_run_up(results: xr.Dataset) -> bool:
    return results.sizes["speed"] > 1


def _of_channel(orders: xr.Dataset, channel: str | None) -> tuple[xr.Dataset, str, str]:
    """A channel, its name, and the end of the names of its files."""
    name = chosen(orders, "channel", channel)
    return orders.sel(channel=name), str(name), dict(numbered(orders, "channel"))[str(name)]


def _unit(of_channel: xr.Dataset) -> str:
    return str(of_channel["channel_unit"].item())


def _without_offset(lines: xr.DataArray, of_channel: xr.Dataset) -> xr.DataArray:
    """Lines above the main lobe of an offset, which is no order."""
    return lines.sel(map_order=lines["map_order"] > 0.5 * of_channel.attrs["band_order"])


def _limits(of_channel: xr.Dataset) -> xr.DataArray | None:
    """Limits of a channel (speed, order), where it has any."""
    return (
        of_channel["order_limit"]
        if "order_limit" in of_channel and of_channel["order_limit"].count()
        else None
    )


def _steady_limits(of_channel: xr.Dataset) -> xr.DataArray | None:
    """Limits by order that hold at every speed alike: a mean spectrum is of all speeds."""
    limits = _limits(of_channel)
    if limits is None:
        return None
    alike = limits.max("speed", skipna=False) == limits.min("speed", skipna=False)
    steady = limits.isel(speed=0, drop=True).where(alike).dropna("order")
    return steady if steady.size else None


def _limit_marks(limits: xr.DataArray, band_order: float) -> Segments:
    half, orders = 0.5 * band_order, limits["order"].values
    label = "limit in an order's band"
    return Segments(orders - half, limits, orders + half, limits, label, COLOURS[1], width=1.5)


@needs("mean_order_spectrum", from_="`analyse_orders`")
def order_spectrum(orders: xr.Dataset, channel: str | None = None) -> Chart:
    """Mean order spectrum of a channel: root mean square of each line.

    With `order_limit` (of `check_limits`), limits that hold at every speed are drawn.

    Parameters
    ----------
    orders : of `analyse_orders`; needs `mean_order_spectrum` (channel, map_order), in
        the channel's unit
    channel : one of the dataset's channels; default: the first
    """
    of_channel, title, file = _of_channel(orders, channel)
    spectrum = _without_offset(of_channel["mean_order_spectrum"], of_channel)
    limits = _steady_limits(of_channel)
    marks = [Curve(spectrum["map_order"], spectrum)]
    others = () if limits is None else (_limit_marks(limits, of_channel.attrs["band_order"]),)
    y = amplitude_axis(
        f"RMS of a line, {_unit(of_channel)}", spectrum, () if limits is None else limits
    )
    return Chart(
        f"spectrum_{file}",
        f"Mean order spectrum of {title}, to order {float(orders['map_order'][-1]):g}.",
        f"Mean order spectrum of {title}: root of the mean power over the blocks.",
        (Panel(Axis("Shaft order", integer=True), y, (*marks, *others), shortened(title)),),
    )


@needs("order_map", from_="`analyse_orders(..., with_map=True)`, command `orders --map`")
def order_map(orders: xr.Dataset, channel: str | None = None) -> Chart:
    """Order spectra of a channel over the speed of a run-up or else the time, dB.

    Reference: 20 µPa of sound pressure, 1 unit peak of others.

    Parameters
    ----------
    orders : of `analyse_orders`; needs `order_map` (channel, block, map_order), in the
        channel's unit
    channel : one of the dataset's channels; default: the first
    """
    of_channel, title, file = _of_channel(orders, channel)
    is_run_up = _is_run_up(orders)
    spectra = _without_offset(of_channel["order_map"].transpose("block", "map_order"), of_channel)
    level, label = map_level(spectra.values, _unit(of_channel))
    along = spectra["block_speed" if is_run_up else "block_time"]
    top = float(np.max(level))
    colours = Image(spectra["map_order"], along, level, (top - _MAP_RANGE_DB, top), label)
    y = Axis("Speed, rpm" if is_run_up else "Time, s")
    return Chart(
        f"map_{file}",
        f"Order map of {title}.",
        f"Order map of {title}: level of each line, {_MAP_RANGE_DB:g} dB shown.",
        (Panel(Axis("Shaft order", integer=True), y, (colours,), shortened(title), 3.4),),
    )


@needs("tracked_order", from_="`track_orders`, command `track`")
def tracked_orders(tracked: xr.Dataset, channel: str | None = None) -> Chart:
    """Amplitude of each tracked order of a channel over speed, peak: a line an order.

    The abscissa is the time where the speed is steady.

    Parameters
    ----------
    tracked : of `track_orders`; needs `tracked_order` (channel, track_time, order)
    channel : one of the dataset's channels; default: the first
    """
    of_channel, title, file = _of_channel(tracked, channel)
    size = abs(of_channel["tracked_order"]).transpose("order", ...)
    varies = is_run_up(tracked["track_speed"])
    along = tracked["track_speed"] if varies else tracked["track_time"]
    names = [f"{order:g}×" for order in size["order"].values]
    marks = lines(along, zip(names, size.values, strict=True))
    y = Axis(f"Peak, {_unit(of_channel)}", limits=(0.0, None))
    bandwidth = f"bandwidth {tracked.attrs['bandwidth_hz']:g} Hz"
    return Chart(
        f"tracked_{file}",
        f"Tracked orders of {title}.",
        f"Tracked orders of {title}: peak amplitude, {bandwidth}.",
        (Panel(Axis("Speed, rpm" if varies else "Time, s"), y, marks, shortened(title), 2.6),),
    )


def tracked_order_charts(tracked: xr.Dataset) -> list[Chart]:
    """Return for each channel the tracked orders over the speed."""
    return [tracked_orders(tracked, str(name)) for name in tracked["channel"].values]


def speed_map_charts(mapped: xr.Dataset) -> list[Chart]:
    """Return for each channel the map; of sound pressure its level too."""
    charts = []
    for name, unit in zip(mapped["channel"].values, mapped["channel_unit"].values, strict=True):
        charts.append(speed_frequency_map(mapped, str(name)))
        if unit == "Pa":
            charts.append(levels_over_speed(mapped, str(name)))
    return charts
