"""Figures of a recording: order spectrum, orders over speed, order map, levels, tracked orders."""

from functools import partial
from typing import Final

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..map_levels import map_level
from ..over_speed.level_curves import is_run_up
from ..titles import chosen
from .levels_over_speed import levels_over_speed
from .needs import needs
from .orders_over_speed import over_speed_picture
from .panels import level_map, lines, logarithmic, one_panel
from .speed_maps import MAP_RANGE_DB, speed_frequency_map
from .style import COLOURS, Picture, in_both_widths, numbered, png, shortened, whole_number_ticks

_MAP_RANGE_DB: Final = 60.0


def recorded_order_figures(results: xr.Dataset) -> list[Picture]:
    """For each channel: mean spectrum, orders over speed in a run-up, and map if there is one."""
    pictures = []
    for channel, name in numbered(results, "channel"):
        pictures.append(_spectrum_picture(results, channel, name))
        if _is_run_up(results):
            pictures.append(over_speed_picture(results, f"orders_{name}", channel))
        if "order_map" in results:
            pictures.append(_map_picture(results, channel, name))
    return pictures


def _is_run_up(results: xr.Dataset) -> bool:
    return results.sizes["speed"] > 1


def _of_channel(orders: xr.Dataset, channel: str | None) -> tuple[xr.Dataset, str]:
    """One channel and its name as a title."""
    name = chosen(orders, "channel", channel)
    return orders.sel(channel=name), shortened(str(name))


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


def _draw_steady_limits(axes: Axes, limits: xr.DataArray, band_order: float) -> None:
    half = 0.5 * band_order
    orders = limits["order"].values
    axes.hlines(
        limits, orders - half, orders + half, colors=COLOURS[1], label="limit in an order's band"
    )


@needs("mean_order_spectrum", from_="`analyse_orders`")
def order_spectrum(orders: xr.Dataset, channel: str | None = None) -> Figure:
    """Mean order spectrum of a channel: root mean square of each line.

    With `order_limit` (of `check_limits`), limits that hold at every speed are drawn.

    Parameters
    ----------
    orders : of `analyse_orders`; needs `mean_order_spectrum` (channel, map_order), in
        the channel's unit
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> va.plot.order_spectrum(orders).savefig("order_spectrum.png")
    """
    of_channel, title = _of_channel(orders, channel)
    spectrum = _without_offset(of_channel["mean_order_spectrum"], of_channel)
    limits = _steady_limits(of_channel)

    def paint(axes: Axes) -> None:
        axes.plot(spectrum["map_order"], spectrum)
        logarithmic(axes, spectrum.values, None if limits is None else limits.values)
        if limits is not None:
            _draw_steady_limits(axes, limits, of_channel.attrs["band_order"])
        whole_number_ticks(axes)

    has_limits = int(limits is not None)
    y = f"RMS of a line, {_unit(of_channel)}"
    return one_panel(2.6, paint, "Shaft order", y, title, columns=has_limits, rows=has_limits)


def _spectrum_picture(results: xr.Dataset, channel: str, name: str) -> Picture:
    highest = float(results["map_order"][-1])
    return Picture(
        f"spectrum_{name}",
        f"Mean order spectrum of {channel}, to order {highest:g}.",
        f"Mean order spectrum of {channel}: root of the mean power over the blocks.",
        png(order_spectrum(results, channel)),
    )


@needs("order_map", from_="`analyse_orders(..., with_map=True)`, command `orders --map`")
def order_map(orders: xr.Dataset, channel: str | None = None) -> Figure:
    """Order spectra of a channel over the speed of a run-up or else the time, dB.

    Reference: 20 µPa of sound pressure, 1 unit peak of others.

    Parameters
    ----------
    orders : of `analyse_orders`; needs `order_map` (channel, block, map_order), in the
        channel's unit
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> va.plot.order_map(orders).savefig("order_map.png")
    """
    of_channel, title = _of_channel(orders, channel)
    is_run_up = _is_run_up(orders)
    spectra = _without_offset(of_channel["order_map"].transpose("block", "map_order"), of_channel)
    spectra = spectra.sortby("block_speed") if is_run_up else spectra
    level, label = map_level(spectra.values, _unit(of_channel))
    along = spectra["block_speed" if is_run_up else "block_time"]

    def paint(axes: Axes) -> None:
        level_map(axes, spectra["map_order"], along, level, _MAP_RANGE_DB, label)
        whole_number_ticks(axes)

    return one_panel(3.4, paint, "Shaft order", "Speed, rpm" if is_run_up else "Time, s", title)


def _map_picture(results: xr.Dataset, channel: str, name: str) -> Picture:
    return Picture(
        f"map_{name}",
        f"Order map of {channel}.",
        f"Order map of {channel}: level of each line, {_MAP_RANGE_DB:g} dB shown.",
        png(order_map(results, channel)),
    )


@needs("tracked_order", from_="`track_orders`, command `track`")
def tracked_orders(tracked: xr.Dataset, channel: str | None = None) -> Figure:
    """Amplitude of each tracked order of a channel over speed, peak: a line an order.

    Of a steady speed over the time instead.

    Parameters
    ----------
    tracked : of `track_orders`; needs `tracked_order` (channel, track_time, order)
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> tracked = va.open_results("tracked_orders.nc")
    >>> va.plot.tracked_orders(tracked).savefig("tracked.png")
    """
    name = chosen(tracked, "channel", channel)
    size = abs(tracked["tracked_order"].sel(channel=name))
    varies = is_run_up(tracked["track_speed"])
    along = tracked["track_speed"] if varies else tracked["track_time"]
    orders = [f"{order:g}×" for order in size["order"].values]

    def paint(axes: Axes) -> None:
        lines(axes, along, orders, size.transpose("order", ...))
        axes.set_ylim(bottom=0.0)

    y = f"Peak, {tracked['channel_unit'].sel(channel=name).item()}"
    x, title = "Speed, rpm" if varies else "Time, s", shortened(str(name))
    return one_panel(2.6, paint, x, y, title, columns=4, rows=-(-len(orders) // 4))


def tracked_order_figures(tracked: xr.Dataset) -> list[Picture]:
    """For each channel: tracked orders over the speed."""
    return [
        Picture(
            f"tracked_{file}",
            f"Tracked orders of {name}.",
            f"Tracked orders of {name}: peak amplitude, bandwidth "
            f"{tracked.attrs['bandwidth_hz']:g} Hz.",
            png(tracked_orders(tracked, name)),
        )
        for name, file in numbered(tracked, "channel")
    ]


def speed_map_figures(mapped: xr.Dataset) -> list[Picture]:
    """For each channel the map; of sound pressure its level too."""
    pictures = []
    for name, file in numbered(mapped, "channel"):
        pictures.append(
            in_both_widths(
                f"speed_map_{file}",
                f"Spectra of {name} over speed and frequency.",
                f"{name} over speed and frequency: level of each line, {MAP_RANGE_DB:g} dB shown.",
                partial(_map, mapped, name),
            )
        )
        if mapped["channel_unit"].sel(channel=name) == "Pa":
            pictures.append(
                in_both_widths(
                    f"levels_{file}",
                    f"Level of {name} over the speed.",
                    f"Level of {name} over the speed, block by block. Shaded: speeds to avoid by "
                    "the A-weighted level.",
                    partial(_levels, mapped, name),
                )
            )
    return pictures


def _map(mapped: xr.Dataset, channel: str, width_inch: float) -> Figure:
    return speed_frequency_map(mapped, channel, width_inch=width_inch)


def _levels(mapped: xr.Dataset, channel: str, width_inch: float) -> Figure:
    return levels_over_speed(mapped, channel, width_inch=width_inch)
