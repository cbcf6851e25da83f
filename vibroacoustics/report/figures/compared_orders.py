"""Orders of two results on top of each other, and how far they are apart."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...results.titles import chosen
from ..charts.axes import amplitude_axis, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Panel, Points, Segments
from ..charts.needs import needs
from ..file_names import numbered

_MOST_PANELS: Final = 4
_MOST_CHANNELS: Final = 6
_COVERAGE: Final = 2.0


def compared_order_charts(compared: xr.Dataset) -> list[Chart]:
    """Return a chart for each channel: both spectra at each speed, or each order over many speeds.

    Channels without an order that both results have are left out.
    """
    has_any = compared["order_difference"].notnull().any(["speed", "order"])
    return [compared_orders(compared, name) for name in compared["channel"].values[has_any.values]]


@needs("order_difference", "compared_order", from_="`compare`")
def compared_orders(compared: xr.Dataset, channel: str | None = None) -> Chart:
    """Orders of a channel in both results, peak: a panel a speed or, of a run-up, an order.

    With `order_limit` (of `check_limits`), the limits are drawn, an RMS as its peak.

    Parameters
    ----------
    compared : of `compare`; needs `channel_order` and `compared_order`
        (channel, speed, order), in the channel's unit
    channel : one of the dataset's channels; default: the first
    """
    name = str(chosen(compared, "channel", channel))
    of_channel = compared.sel(channel=name)
    by_speed = of_channel.sizes["speed"] <= _MOST_PANELS
    sizes = [abs(of_channel["channel_order"]), abs(of_channel["compared_order"])]
    limits = None
    if "order_limit" in of_channel and of_channel["order_limit"].count():
        limits = np.sqrt(2.0) * of_channel["order_limit"]
    x = Axis("Speed, rpm")
    if by_speed:
        x = _order_axis(float(of_channel["order"].max()))
    label = f"Peak, {of_channel['channel_unit'].item()}"
    y = amplitude_axis(label, np.stack(sizes), () if limits is None else limits)
    across, along = ("speed", "order") if by_speed else ("order", "speed")
    lowest = y.limits[0] if y.limits and y.limits[0] is not None else 0.0
    is_shown = ((sizes[0] > lowest) | (sizes[1] > lowest)).any(along)
    shown = of_channel[across].where(is_shown, drop=True).values[:_MOST_PANELS]
    named = (of_channel.attrs["first"], of_channel.attrs["second"])
    panels = []
    for value in shown.tolist():
        some = [
            size.sel({across: value}) for size in (*sizes, *([] if limits is None else [limits]))
        ]
        where = f"{value:.0f} rpm" if by_speed else f"order {value:g}"
        marks = tuple(_points(some, named, stems=by_speed))
        panels.append(Panel(x, y, marks, f"{shortened(name, 40)}, {where}", 2.4))
    return Chart(
        f"compared_{dict(numbered(compared, 'channel'))[name]}",
        f"Orders of {name} in both results.",
        f"{name}: {named[0]} (circles) and {named[1]} (crosses).",
        stacked(panels),
    )


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
    compared : of `compare`; needs `order_difference` (channel, speed, order), dB
    channels : at most six are drawn; default: the first with values
    """
    difference = compared["order_difference"]
    with_values = difference.dropna("channel", how="all")["channel"].values
    shown = (list(channels) or [str(name) for name in with_values])[:_MOST_CHANNELS]
    x = _order_axis(float(difference["order"].where(difference.notnull()).max()))
    panels = [
        Panel(
            x, Axis("B − A, dB"), (*_differences(compared, shown, speed),), f"{speed:.0f} rpm", 2.2
        )
        for speed in difference["speed"].values[:_MOST_PANELS]
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
    compared: xr.Dataset, channels: Sequence[str], speed: float
) -> Iterator[Points | Segments]:
    yield Segments([np.nan], [0.0], [np.nan], [0.0], width=0.8)
    order = compared["order"].values
    for number, name in enumerate(channels):
        position = {"channel": name, "speed": speed}
        values = compared["order_difference"].sel(position).values
        reach = _reach(compared, position)
        yield Points(
            order + 0.08 * (number - (len(channels) - 1) / 2.0), values, shortened(name),
            None if reach is None else (values - reach, values + reach),
            COLOURS[1 + number], filled=False,
        )  # fmt: skip


def _reach(compared: xr.Dataset, position: dict[str, Any]) -> Array | None:
    if "order_mean_uncertainty" not in compared:
        return None
    return _COVERAGE * np.nan_to_num(compared["order_mean_uncertainty"].sel(position).values)
