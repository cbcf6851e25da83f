"""Figures of a recording's orders: spectrum, orders over speed, order map."""

from typing import Final

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..map_levels import map_level
from ..titles import chosen
from .needs import needs
from .orders_over_speed import over_speed_picture
from .panels import level_map, logarithmic, one_panel
from .style import COLOURS, Picture, numbered, png, shortened, whole_number_ticks

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
