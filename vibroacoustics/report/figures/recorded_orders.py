"""Figures of a recording's orders: spectrum, orders over speed, order map."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from ..map_levels import map_level
from ..titles import chosen
from .needs import needs
from .orders_over_speed import over_speed_picture
from .style import (
    COLOURS,
    Picture,
    draw,
    legend_below,
    numbered_file_name,
    png,
    shortened,
    whole_number_ticks,
)

_MAP_RANGE_DB: Final = 60.0
_QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""


def recorded_order_figures(results: xr.Dataset) -> list[Picture]:
    """For each channel: mean spectrum, orders over speed in a run-up, and map if there is one."""
    pictures = []
    for number, channel in enumerate(map(str, results["channel"].values), 1):
        name = numbered_file_name(number, channel)
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


_DECADES: Final = 100.0
"""Range of a logarithmic axis from which on it has ticks at powers of ten alone."""


def _logarithmic(axes: Axes, shown: xr.DataArray, limits: xr.DataArray | None = None) -> None:
    """Logarithmic axis over what is shown, unless it is next to nothing, and over its limits."""
    sizes = shown.values.ravel()
    highest = float(sizes.max())
    if highest > 0.0:
        allowed = np.array([]) if limits is None else limits.values[np.isfinite(limits.values)]
        bottom = max(0.5 * float(sizes.min()), _QUIETEST * highest)
        bottom, top = min([bottom, *0.5 * allowed]), 2.0 * max([highest, *allowed])
        axes.set_yscale("log")
        axes.set_ylim(bottom, top)
        if top > _DECADES * bottom:
            axes.yaxis.set_minor_locator(NullLocator())  # they take half the time of a picture


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
    legend_below(axes, 1)


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

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        axes.plot(spectrum["map_order"], spectrum)
        _logarithmic(axes, spectrum, limits)
        if limits is not None:
            _draw_steady_limits(axes, limits, of_channel.attrs["band_order"])
        whole_number_ticks(axes)
        axes.set_xlabel("Shaft order")
        axes.set_ylabel(f"RMS of a line, {_unit(of_channel)}")
        axes.set_title(title, loc="left")

    return draw(1, 2.6, paint, 0 if limits is None else 1)


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
    top = float(level.max())

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        shown = axes.pcolormesh(
            spectra["map_order"],
            spectra["block_speed" if is_run_up else "block_time"],
            level,
            vmin=top - _MAP_RANGE_DB,
            vmax=top,
            shading="nearest",
            rasterized=True,
        )
        figure = axes.get_figure()
        if figure is not None:
            figure.colorbar(shown, ax=axes, label=label)
        axes.grid(visible=False)
        whole_number_ticks(axes)
        axes.set_xlabel("Shaft order")
        axes.set_ylabel("Speed, rpm" if is_run_up else "Time, s")
        axes.set_title(title, loc="left")

    return draw(1, 3.4, paint, 0)


def _map_picture(results: xr.Dataset, channel: str, name: str) -> Picture:
    return Picture(
        f"map_{name}",
        f"Order map of {channel}.",
        f"Order map of {channel}: level of each line, {_MAP_RANGE_DB:g} dB shown.",
        png(order_map(results, channel)),
    )
