"""Order cuts over the speed, of a study, a recording or two results."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.order_cuts import OrderCuts, order_cuts
from ..charts.axes import amplitude_axis, level_axis
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from ..file_names import numbered
from .levels_over_speed import FEW_POINTS

_OF_RESULTS: Final = ("-", "--")


@needs(
    "block_order_rms", "compared_order_rms", "pressure_line", any_of=True,
    from_="`run`, `analyse_orders` or `compare`",
)  # fmt: skip
def orders_over_speed(
    orders: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> Chart:
    """Order cuts of a channel over the speed: a line an order.

    Of sound pressure levels, dB re 20 µPa, unweighted. Of a study or a comparison the eight
    strongest orders, after weighting by A where they are sound; of a comparison solid lines are the
    first result, dashed ones the second. With `order_limit` (of `check_limits`), limits are drawn
    in the colours of their orders.

    Parameters
    ----------
    orders : of `analyse_orders`, needs `block_order_rms` (channel, block, order); of `compare`,
        needs `compared_order_rms`; or of `run`, needs `pressure_line`
    channel : named as in `compare`; default: of a study the microphone of the catalogue's noise,
        else the first
    option : of a study
    """
    cuts = order_cuts(orders, channel, option)
    if "block_order_rms" in orders:
        name, words = f"orders_{dict(numbered(orders, 'channel'))[cuts.channel]}", ""
        by, title = ", block by block.", ""
    elif len(cuts.rms) > 1:
        name, words = f"over_speed_{dict(numbered(orders, 'channel'))[cuts.channel]}", ""
        by, title = ". Solid: A, dashed: B.", "; solid A, dashed B"
    else:
        name, words, by, title = "orders_over_speed", f", option {option}", ".", ""
    title = f"{shortened(cuts.channel, 60)}{title}"
    return Chart(
        name,
        f"Orders of {cuts.channel} over the speed.",
        f"Orders of {cuts.channel}{words} over the speed{by}",
        (Panel(Axis("Speed, rpm"), _axis(cuts), tuple(_lines(cuts)), title, 2.8),),
        wide=True,
    )


def _lines(cuts: OrderCuts) -> Iterator[Line]:
    """Yield each order of all results, and its limit."""
    marker = "o" if cuts.speed_rpm.size <= FEW_POINTS else ""
    several = len(cuts.rms) > 1
    for number, order in enumerate(cuts.order):
        colour = COLOURS[number % len(COLOURS)]
        for result, rms in enumerate(cuts.shown(cuts.rms[:, number])):
            name = "" if result else f"{order:g}×"
            looks = (colour, _OF_RESULTS[result]) if several else ("", "")
            yield Line(cuts.speed_rpm, rms, name, None, *looks, marker)
        if cuts.limits is not None:
            name, shown = "" if number else "limits", cuts.shown(cuts.limits[number])
            yield Line(cuts.speed_rpm, shown, name, None, colour, "-", marker and "_", 0.8)


def _axis(cuts: OrderCuts) -> Axis:
    """Return levels down to a range below the highest; of others a logarithmic axis."""
    limits = np.empty(0) if cuts.limits is None else cuts.limits
    if cuts.unit == "Pa":
        shown = cuts.shown(np.concatenate([cuts.rms.ravel(), limits.ravel()]))
        return level_axis("Level, dB re 20 µPa", shown)
    return amplitude_axis(f"RMS in the order's band, {cuts.unit}", cuts.rms, limits)
