"""Figures of a recording over speed: spectra, levels, tracked orders."""

from functools import partial

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..over_speed.level_curves import is_run_up
from ..titles import chosen
from .levels_over_speed import levels_over_speed
from .needs import needs
from .panels import lines, one_panel
from .speed_maps import MAP_RANGE_DB, speed_frequency_map
from .style import Picture, in_both_widths, numbered, png, shortened


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
