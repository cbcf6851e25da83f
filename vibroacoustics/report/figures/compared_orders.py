"""Orders of two results on top of each other, and how far they are apart."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array
from ..charts.needs import needs
from ..titles import chosen
from .panels import each_panel
from .style import COLOURS, MARKERS, Picture, numbered, png, shortened, whole_number_ticks

_MOST_PANELS: Final = 4
_QUIETEST: Final = 1e-5
"""Lowest amplitude that is drawn, as a share of the largest."""


def compared_order_figures(compared: xr.Dataset) -> list[Picture]:
    """For each channel: both spectra at each speed, or each order over many speeds.

    Channels without an order that both results have are left out.
    """
    return [
        _picture(compared, name, file)
        for name, file in numbered(compared, "channel")
        if np.isfinite(compared["order_difference"].sel(channel=name)).any()
    ]


@needs("order_difference", "compared_order", from_="`compare`")
def compared_orders(compared: xr.Dataset, channel: str | None = None) -> Figure:
    """Orders of a channel in both results, peak: a panel a speed or, of a run-up, an order.

    With `order_limit` (of `check_limits`), the limits are drawn, an RMS as its peak.

    Parameters
    ----------
    compared : of `compare`; needs `channel_order` and `compared_order`
        (channel, speed, order), in the channel's unit
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> compared = va.open_results("compared_orders.nc")
    >>> va.plot.compared_orders(compared).savefig("compared_orders.png")
    """
    of_channel = compared.sel(channel=chosen(compared, "channel", channel))
    by_speed = of_channel.sizes["speed"] <= _MOST_PANELS
    across, within = ("speed", "order") if by_speed else ("order", "speed")
    panel_values = of_channel[across].values[:_MOST_PANELS]
    title = shortened(str(of_channel["channel"].item()))
    labels = (of_channel.attrs["first"], of_channel.attrs["second"])
    size = xr.concat(
        [abs(of_channel["channel_order"]), abs(of_channel["compared_order"])], "result"
    )
    largest = float(size.max())
    drawn = size.where(size > _QUIETEST * largest)
    has_limits = "order_limit" in of_channel and of_channel["order_limit"].count()
    limits = np.sqrt(2.0) * of_channel["order_limit"] if has_limits else None
    sizes = np.concatenate([drawn.values.ravel(), [] if limits is None else limits.values.ravel()])
    bottom, top = 0.5 * float(np.nanmin(sizes)), 2.0 * float(np.nanmax(sizes))

    looks = list(zip(labels, (COLOURS[3], COLOURS[1]), "ox", (8, 6), strict=True))

    def paint(axes: Axes, value: float) -> None:
        for shown, (label, colour, marker, width) in zip(
            drawn.sel({across: value}), looks, strict=True
        ):
            if by_speed:
                axes.vlines(shown[within], bottom, shown, color=colour, alpha=0.4)
            axes.semilogy(
                shown[within], shown, marker, color=colour, label=shortened(label),
                markersize=width, fillstyle="none",
            )  # fmt: skip
        if limits is not None:
            axes.semilogy(
                limits[within], limits.sel({across: value}), "_", color=COLOURS[5],
                label="limit, as a peak", markersize=12,
            )  # fmt: skip
        axes.set_ylim(bottom, top)
        if by_speed:
            axes.set_xlim(0.0, float(of_channel["order"].max()) + 0.5)
            whole_number_ticks(axes)

    return each_panel(
        panel_values, 2.2, paint, "Shaft order" if by_speed else "Speed, rpm",
        f"Peak, {of_channel['channel_unit'].item()}",
        lambda value: f"{title}, {f'{value:.0f} rpm' if by_speed else f'order {value:g}'}",
        columns=1, rows=2 + (limits is not None), sharex=True,
    )  # fmt: skip


def _picture(compared: xr.Dataset, channel: str, name: str) -> Picture:
    labels = (compared.attrs["first"], compared.attrs["second"])
    return Picture(
        f"compared_{name}",
        f"Orders of {channel} in both results.",
        f"{channel}: {labels[0]} (circles) and {labels[1]} (crosses).",
        png(compared_orders(compared, channel)),
    )


_MOST_CHANNELS: Final = 6
_COVERAGE: Final = 2.0


def difference_picture(compared: xr.Dataset) -> Picture:
    """Differences of all shown channels."""
    with_bars = "order_mean_uncertainty" in compared
    bars = " Bars: twice the standard uncertainty of the mean of the runs." if with_bars else ""
    return Picture(
        "compared_differences",
        "Level of each order in B less that in A, a marker a channel; numbers are in the tables.",
        f"B − A: {compared.attrs['second']} less {compared.attrs['first']}.{bars}",
        png(order_differences(compared)),
    )


@needs("order_difference", from_="`compare`")
def order_differences(compared: xr.Dataset, channels: Sequence[str] = ()) -> Figure:
    """Level of each order in the second result less that in the first, a panel a speed.

    With several runs behind the second result, bars are twice the standard uncertainty of its mean.

    Parameters
    ----------
    compared : of `compare`; needs `order_difference` (channel, speed, order), dB
    channels : at most six are drawn; default: the first with values

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> compared = va.open_results("compared_orders.nc")
    >>> va.plot.order_differences(compared).savefig("differences.png")
    """
    difference = compared["order_difference"]
    known = [str(name) for name in difference.dropna("channel", how="all")["channel"].values]
    shown = (list(channels) or known)[:_MOST_CHANNELS]
    speeds = difference["speed"].values[:_MOST_PANELS]

    highest = difference["order"].where(difference.notnull()).max().item()

    def paint(axes: Axes, speed: float) -> None:
        axes.axhline(0.0, color=COLOURS[0], linewidth=0.8)
        for number, name in enumerate(shown):
            at = {"channel": name, "speed": speed}
            axes.errorbar(
                difference["order"] + 0.08 * (number - (len(shown) - 1) / 2.0),
                difference.sel(at),
                yerr=_reach(compared, at),
                fmt=MARKERS[number % len(MARKERS)],
                color=COLOURS[1 + number],
                markersize=5,
                fillstyle="none",
                capsize=2,
                label=shortened(name),
            )
        whole_number_ticks(axes)
        axes.set_xlim(0.0, highest + 0.5)

    return each_panel(
        speeds, 2.0, paint, "Shaft order", "B − A, dB", lambda speed: f"{speed:.0f} rpm",
        columns=2, rows=(len(shown) + 1) // 2, sharex=True,
    )  # fmt: skip


def _reach(compared: xr.Dataset, at: dict[str, object]) -> Array | None:
    if "order_mean_uncertainty" not in compared:
        return None
    return np.asarray(np.nan_to_num(_COVERAGE * compared["order_mean_uncertainty"].sel(at).values))
