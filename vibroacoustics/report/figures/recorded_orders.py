"""Charts of a recording: order spectrum, orders over speed, order map, levels, tracked orders."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ...results.map_levels import map_level
from ...results.over_speed.level_curves import is_run_up
from ..charts.layout import shortened
from ..charts.marks import Axis, Chart, Image, Panel, Segments, lines
from ..charts.marks import Line as Curve
from ..charts.needs import needs
from ..charts.picture import Picture, picture
from ..titles import chosen
from .levels_over_speed import levels_over_speed
from .orders_over_speed import over_speed_picture
from .speed_maps import MAP_RANGE_DB, speed_frequency_map
from .style import COLOURS, in_both_widths, numbered

_MAP_RANGE_DB: Final = 60.0
_QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""


def recorded_order_figures(results: xr.Dataset) -> list[Picture]:
    """For each channel: mean spectrum, orders over speed in a run-up, and map if there is one."""
    pictures = []
    for channel, name in numbered(results, "channel"):
        pictures.append(picture(order_spectrum(results, channel)))
        if _is_run_up(results):
            pictures.append(over_speed_picture(results, f"orders_{name}", channel))
        if "order_map" in results:
            pictures.append(picture(order_map(results, channel)))
    return pictures


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
    y = Axis(f"RMS of a line, {_unit(of_channel)}", "log", _amplitude_limits(spectrum, limits))
    return Chart(
        f"spectrum_{file}",
        f"Mean order spectrum of {title}, to order {float(orders['map_order'][-1]):g}.",
        f"Mean order spectrum of {title}: root of the mean power over the blocks.",
        (Panel(Axis("Shaft order", integer=True), y, (*marks, *others), shortened(title)),),
    )


def _amplitude_limits(
    sizes: xr.DataArray, limits: xr.DataArray | None
) -> tuple[float, float] | None:
    """Ends of a logarithmic axis over sizes and their limits; None where all are zero."""
    highest = float(sizes.max())
    if not highest > 0.0:
        return None
    allowed = [] if limits is None else limits.values.ravel().tolist()
    lowest = max(0.5 * float(sizes.min()), _QUIETEST * highest)
    return min([lowest, *(0.5 * limit for limit in allowed)]), 2.0 * max([highest, *allowed])


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


def tracked_order_figures(tracked: xr.Dataset) -> list[Picture]:
    """For each channel: tracked orders over the speed."""
    names = map(str, tracked["channel"].values)
    return [picture(tracked_orders(tracked, name)) for name in names]


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
