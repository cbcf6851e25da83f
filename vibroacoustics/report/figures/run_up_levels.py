"""Overall level and loudest orders of a recorded run-up in one chart."""

from itertools import cycle
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...results.over_speed.loudest_orders import LoudestOrders, loudest_orders
from ..charts.axes import level_axis
from ..charts.layout import COLOURS, DASHES, shortened
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from ..file_names import numbered
from .levels_over_speed import FEW_POINTS

_RANGE_DB: Final = 60.0
_LOOKS: Final = tuple(zip(COLOURS[1:], cycle(DASHES), strict=False))
"""Colour and dash of each order; the overall level has the first colour."""


@needs("order_map", from_="`analyse_orders(..., with_map=True)`, command `orders` of a run-up")
def run_up_levels(orders: xr.Dataset, channel: str | None = None) -> Chart:
    """Overall level and loudest orders of a channel over the speed of a run-up.

    Sound pressure is in dB(A), other units are in dB re 1 unit, root mean square, without the
    overall level. An order's level is that in its band.

    Parameters
    ----------
    orders : result of `analyse_orders`; needs `order_map` (channel, block, map_order)
    channel : one of the dataset's channels; default: the first
    """
    curves = loudest_orders(orders, channel)
    return run_up_chart(curves, dict(numbered(orders, "channel"))[curves.channel])


def run_up_chart(curves: LoudestOrders, file: str) -> Chart:
    """Return overall level and loudest orders as a chart; file: end of the name of its file."""
    marker = "o" if curves.speed_rpm.size <= FEW_POINTS else ""
    lines = [
        Line(curves.speed_rpm, level_db, f"{order:.4g}×", None, *looks, marker)
        for order, level_db, looks in zip(curves.order, curves.level_db, _LOOKS, strict=False)
    ]
    shown: Array = curves.level_db
    what = "Loudest orders"
    if curves.overall_db is not None:
        overall = Line(
            curves.speed_rpm, curves.overall_db, "overall", None, COLOURS[0], "-", marker, 2.2
        )
        lines, what = [overall, *lines], "Overall level and loudest orders"
        shown = np.vstack([shown, curves.overall_db])
    y = level_axis(f"Level, {curves.reference}", shown, _RANGE_DB)
    return Chart(
        f"run_up_{file}",
        f"{what} of {curves.channel} over the speed.",
        f"{what} of {curves.channel} over the speed, block by block; an order in its band.",
        (Panel(Axis("Speed, rpm"), y, tuple(lines), shortened(curves.channel, 60), 2.8),),
        wide=True,
    )
