"""Orders of channels: of a recording, and of two results on top of each other."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...results.map_levels import map_level
from ...results.over_speed.level_curves import is_run_up
from ...results.over_speed.loudest_orders import LoudestOrders
from ...results.titles import chosen
from ..charts.axes import MAP_RANGE_DB, amplitude_axis, level_image, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Mark, Panel, Points, Segments, lines
from ..charts.needs import needs
from ..file_names import numbered
from .levels_over_speed import levels_over_speed
from .orders_over_speed import orders_over_speed, speed_frequency_map
from .run_up_levels import run_up_chart


def recorded_order_charts(
    results: xr.Dataset, loudest: Sequence[LoudestOrders] = ()
) -> dict[str, list[Chart]]:
    """Return by channel: levels and map of a run-up, mean spectrum.

    Orders of the analysis over the speed are shown where they have limits, or without levels.

    Parameters
    ----------
    results : result of `analyse_orders`
    loudest : overall level and orders of every channel of a run-up with its map; else none
    """
    by_channel = {}
    levels = {curves.channel: curves for curves in loudest}
    for channel, file in numbered(results, "channel"):
        charts: list[Chart] = []
        by_channel[channel] = charts
        if channel in levels:
            charts.append(run_up_chart(levels[channel], file))
        if "order_map" in results:
            charts.append(order_map(results, channel))
        with_limits = bool(limits_of(results.sel(channel=channel)))
        if np.unique(results["speed"]).size > 1 and (with_limits or channel not in levels):
            charts.append(orders_over_speed(results, channel))
        charts.append(order_spectrum(results, channel))
    return by_channel


def _of_channel(orders: xr.Dataset, channel: str | None) -> tuple[xr.Dataset, str, str]:
    """A channel, its name, and the end of the names of its files."""
    name = chosen(orders, "channel", channel)
    return orders.sel(channel=name), str(name), dict(numbered(orders, "channel"))[str(name)]


def _unit(of_channel: xr.Dataset) -> str:
    return str(of_channel["channel_unit"].item())


def _without_offset(lines: xr.DataArray, of_channel: xr.Dataset) -> xr.DataArray:
    """Lines above the main lobe of an offset, which is no order."""
    return lines.sel(map_order=lines["map_order"] > 0.5 * of_channel.attrs["band_order"])


def _steady_limits(of_channel: xr.Dataset) -> list[xr.DataArray]:
    """Limits by order that hold at every speed alike: a mean spectrum is of all speeds."""
    steady = []
    for limits in limits_of(of_channel):
        alike = limits.max("speed", skipna=False) == limits.min("speed", skipna=False)
        steady.append(limits.isel(speed=0, drop=True).where(alike).dropna("order"))
    return [limits for limits in steady if limits.size]


@needs("mean_order_spectrum", from_="`analyse_orders`")
def order_spectrum(orders: xr.Dataset, channel: str | None = None) -> Chart:
    """Mean order spectrum of a channel: root mean square of each line.

    With `order_limit` (of `check_limits`), limits that hold at every speed are drawn.

    Parameters
    ----------
    orders : result of `analyse_orders`; needs `mean_order_spectrum` (channel, map_order), in
        the channel's unit
    channel : one of the dataset's channels; default: the first
    """
    of_channel, title, file = _of_channel(orders, channel)
    spectrum = _without_offset(of_channel["mean_order_spectrum"], of_channel)
    limits, half = _steady_limits(of_channel), 0.5 * of_channel.attrs["band_order"]
    marks: list[Mark] = [Line(spectrum["map_order"], spectrum)]
    for limit in limits:
        first, last = (limit["order"].values + end for end in (-half, half))
        words = "limit in an order's band"
        marks.append(Segments(first, limit, last, limit, words, COLOURS[1], width=1.5))
    y = amplitude_axis(f"RMS of a line, {_unit(of_channel)}", spectrum, limits)
    return Chart(
        f"spectrum_{file}",
        f"Mean order spectrum of {title}, to order {float(orders['map_order'][-1]):g}.",
        f"Mean order spectrum of {title}: root of the mean power over the blocks.",
        (Panel(Axis("Shaft order", integer=True), y, tuple(marks), shortened(title)),),
    )


@needs("order_map", from_="`analyse_orders(..., with_map=True)`, command `orders --map`")
def order_map(orders: xr.Dataset, channel: str | None = None) -> Chart:
    """Order spectra of a channel over the speed of a run-up or else the time, dB.

    Reference: 20 µPa of sound pressure, 1 unit peak of others.

    Parameters
    ----------
    orders : result of `analyse_orders`; needs `order_map` (channel, block, map_order), in the
        channel's unit
    channel : one of the dataset's channels; default: the first
    """
    of_channel, title, file = _of_channel(orders, channel)
    spectra = _without_offset(of_channel["order_map"].transpose("block", "map_order"), of_channel)
    speeds = orders.sizes["speed"] > 1
    level, label = map_level(spectra.values, _unit(of_channel))
    along = spectra["block_speed" if speeds else "block_time"]
    colours = level_image(spectra["map_order"], along, level, label)
    y = Axis("Speed, rpm" if speeds else "Time, s")
    return Chart(
        f"map_{file}",
        f"Order map of {title}.",
        f"Order map of {title}: level of each line, {MAP_RANGE_DB:g} dB shown.",
        (Panel(Axis("Shaft order", integer=True), y, (colours,), shortened(title), 3.4),),
    )


@needs("tracked_order", from_="`track_orders`, command `track`")
def tracked_orders(tracked: xr.Dataset, channel: str | None = None) -> Chart:
    """Amplitude of each tracked order of a channel over speed, peak: a line an order.

    The abscissa is the time where the speed is steady.

    Parameters
    ----------
    tracked : result of `track_orders`; needs `tracked_order` (channel, track_time, order)
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


_MOST_PANELS: Final = 4
_MOST_CHANNELS: Final = 6
_COVERAGE: Final = 2.0


def compared_order_charts(compared: xr.Dataset) -> list[Chart]:
    """Return a chart for each channel: both spectra at each speed, or each order over many speeds.

    Channels without an order that both results have are omitted.
    """
    has_any = compared["order_difference"].notnull().any(["speed", "order"])
    return [compared_orders(compared, name) for name in compared["channel"].values[has_any.values]]


@needs("order_difference", "compared_order", from_="`compare`")
def compared_orders(compared: xr.Dataset, channel: str | None = None) -> Chart:
    """Orders of a channel in both results, peak: a panel a speed or, of a run-up, an order.

    With `order_limit` (of `check_limits`), the limits are drawn, an RMS as its peak.

    Parameters
    ----------
    compared : result of `compare`; needs `channel_order` and `compared_order`
        (channel, speed, order), in the channel's unit
    channel : one of the dataset's channels; default: the first
    """
    name = str(chosen(compared, "channel", channel))
    of_channel = compared.sel(channel=name)
    by_speed = of_channel.sizes["speed"] <= _MOST_PANELS
    sizes = [abs(of_channel["channel_order"]), abs(of_channel["compared_order"])]
    limits = [np.sqrt(2.0) * limit for limit in limits_of(of_channel)]
    x = _order_axis(float(of_channel["order"].max())) if by_speed else Axis("Speed, rpm")
    y = amplitude_axis(f"Peak, {of_channel['channel_unit'].item()}", np.stack(sizes), limits)
    across, along = ("speed", "order") if by_speed else ("order", "speed")
    lowest = y.limits[0] if y.limits and y.limits[0] is not None else 0.0
    is_shown = ((sizes[0] > lowest) | (sizes[1] > lowest)).any(along)
    shown = np.flatnonzero(is_shown.values)[:_MOST_PANELS]
    named = (of_channel.attrs["first"], of_channel.attrs["second"])
    panels = []
    for number in shown.tolist():
        some = [size.isel({across: number}) for size in (*sizes, *limits)]
        value = of_channel[across].values[number]
        where = f"{value:.0f} rpm" if by_speed else f"order {value:g}"
        marks = tuple(_points(some, named, stems=by_speed))
        panels.append(Panel(x, y, marks, f"{shortened(name, 40)}, {where}", 2.4))
    return Chart(
        f"compared_{dict(numbered(compared, 'channel'))[name]}",
        f"Orders of {name} in both results.",
        f"{name}: {named[0]} (circles) and {named[1]} (crosses).",
        stacked(panels),
    )


def limits_of(of_channel: xr.Dataset) -> list[xr.DataArray]:
    """Return the limits of a channel (speed, order), root mean squares; none where it has none."""
    has_any = "order_limit" in of_channel and of_channel["order_limit"].count()
    return [of_channel["order_limit"]] if has_any else []


def _points(sizes: Sequence[xr.DataArray], named: Sequence[str], stems: bool) -> Iterator[Points]:
    """Yield both results, and the limits where they are given."""
    looks = zip((COLOURS[3], COLOURS[1]), "ox", (8.0, 6.0), strict=True)
    x = sizes[0][sizes[0].dims[0]]
    for size, name, (colour, marker, width) in zip(sizes[:2], named, looks, strict=True):
        yield Points(x, size, shortened(name), None, colour, marker, width, False, stems)
    for limit in sizes[2:]:
        yield Points(x, limit, "limit, as a peak", None, COLOURS[5], "_", 12.0)


def _order_axis(highest: float) -> Axis:
    return Axis("Shaft order", limits=(0.0, highest + 0.5), integer=True)


@needs("order_difference", from_="`compare`")
def order_differences(compared: xr.Dataset, channels: Sequence[str] = ()) -> Chart:
    """Level of each order in the second result less that in the first, a panel a speed.

    With several runs behind the second result, bars are twice the standard uncertainty of its mean.

    Parameters
    ----------
    compared : result of `compare`; needs `order_difference` (channel, speed, order), dB
    channels : at most six are drawn; default: the first with values
    """
    difference = compared["order_difference"]
    with_values = difference.dropna("channel", how="all")["channel"].values
    shown = (list(channels) or [str(name) for name in with_values])[:_MOST_CHANNELS]
    x = _order_axis(float(difference["order"].where(difference.notnull()).max()))
    y = Axis("B − A, dB")
    panels = [
        Panel(x, y, tuple(_differences(compared, shown, number)), f"{speed:.0f} rpm", 2.2)
        for number, speed in enumerate(difference["speed"].values[:_MOST_PANELS])
    ]
    with_bars = "order_mean_uncertainty" in compared
    bars = " Bars: twice the standard uncertainty of the mean of the runs." if with_bars else ""
    return Chart(
        "compared_differences",
        "Level of each order in B less that in A, a marker a channel; numbers are in the tables.",
        f"B − A: {compared.attrs['second']} less {compared.attrs['first']}.{bars}",
        stacked(panels),
    )


def _differences(
    compared: xr.Dataset, channels: Sequence[str], point: int
) -> Iterator[Points | Segments]:
    yield Segments([np.nan], [0.0], [np.nan], [0.0], width=0.8)
    for number, name in enumerate(channels):
        case = compared.sel(channel=name).isel(speed=point)
        values, interval = case["order_difference"].values, None
        if "order_mean_uncertainty" in case:
            reach = _COVERAGE * np.nan_to_num(case["order_mean_uncertainty"].values)
            interval = (values - reach, values + reach)
        x = case["order"].values + 0.08 * (number - (len(channels) - 1) / 2.0)
        yield Points(x, values, shortened(name), interval, COLOURS[1 + number], filled=False)
