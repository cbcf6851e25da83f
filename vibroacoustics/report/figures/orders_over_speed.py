"""Order cuts over the speed, of a study, a recording or two results."""

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array
from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.order_cuts import OrderCuts, order_cuts
from ..charts.needs import needs
from .panels import logarithmic, one_panel
from .style import WIDTH_INCH, Picture, in_both_widths, line_looks, shortened

_RANGE_DB: Final = 80.0
"""Levels further below the highest are not drawn."""
_FEW_POINTS: Final = 12
"""Speeds that get a marker each."""
_OF_LIMITS: Final = {"linewidth": 0.8, "marker": "_", "markersize": 4.0, "linestyle": "-"}
"""Look of limits, in the colour of their order."""
_OF_RESULTS: Final = ("-", "--")


@needs(
    "block_order_rms", "compared_order_rms", "pressure_line", any_of=True,
    from_="`run`, `analyse_orders` or `compare`",
)  # fmt: skip
def orders_over_speed(
    orders: xr.Dataset,
    channel: str | None = None,
    option: str = REFERENCE_OPTION,
    width_inch: float = WIDTH_INCH,
) -> Figure:
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
    width_inch : of the figure

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel or option.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> va.plot.orders_over_speed(orders).savefig("orders_over_speed.png")
    """
    cuts = order_cuts(orders, channel, option)

    def paint(axes: Axes) -> None:
        for number, look in enumerate(line_looks(cuts.order.size)):
            _lines(axes, cuts, number, look)
        _scale(axes, cuts)

    columns = 8 if width_inch > WIDTH_INCH else 4
    rows = -(-(cuts.order.size + (cuts.limits is not None)) // columns)
    y = "Level, dB re 20 µPa" if cuts.unit == "Pa" else f"RMS in the order's band, {cuts.unit}"
    title = f"{shortened(cuts.channel, 40)}{'; solid A, dashed B' if len(cuts.rms) > 1 else ''}"
    return one_panel(2.6, paint, "Speed, rpm", y, title, columns, rows, width_inch)


def over_speed_picture(
    orders: xr.Dataset, name: str, channel: str | None = None, option: str = REFERENCE_OPTION
) -> Picture:
    """Order cuts of a channel.

    Parameters
    ----------
    orders : as of `orders_over_speed`
    name : of the file
    channel, option : as of `orders_over_speed`
    """
    cuts = order_cuts(orders, channel, option)
    which = "" if len(cuts.rms) > 1 or "block_order_rms" in orders else f", option {option}"
    both = " Solid: A, dashed: B." if len(cuts.rms) > 1 else ""
    by = ", block by block" if "block_order_rms" in orders else ""
    return in_both_widths(
        name,
        f"Orders of {cuts.channel} over the speed.",
        f"Orders of {cuts.channel}{which} over the speed{by}.{both}",
        lambda width: orders_over_speed(orders, channel, option, width),
    )


def _lines(axes: Axes, cuts: OrderCuts, number: int, look: dict[str, Any]) -> None:
    """An order of all results, and its limit."""
    points = cuts.shown(cuts.rms[:, number])
    marker = "o" if cuts.speed_rpm.size <= _FEW_POINTS else ""
    for result, of_result in enumerate(points):
        dash = {} if len(points) == 1 else {"linestyle": _OF_RESULTS[result]}
        name = f"{cuts.order[number]:g}×" if result == 0 else "_nolegend_"
        styled = {**look, **dash, "marker": marker, "markersize": 3.0}
        axes.plot(cuts.speed_rpm, of_result, label=name, **styled)
    if cuts.limits is not None:
        name = "limits" if number == 0 else "_nolegend_"
        shown = cuts.shown(cuts.limits[number])
        axes.plot(cuts.speed_rpm, shown, label=name, **{**look, **_OF_LIMITS})


def _scale(axes: Axes, cuts: OrderCuts) -> None:
    """Levels down to a range below the highest; of others a logarithmic axis, if there is any."""
    if cuts.unit == "Pa":
        both = [cuts.rms] if cuts.limits is None else [cuts.rms, cuts.limits]
        _level_scale(axes, cuts.shown(np.concatenate([rms.ravel() for rms in both])))
    else:
        logarithmic(axes, cuts.rms, cuts.limits)


def _level_scale(axes: Axes, levels: Array) -> None:
    known = levels[np.isfinite(levels)]
    if known.size:
        top = float(known.max()) + 3.0
        axes.set_ylim(max(float(known.min()) - 3.0, top - _RANGE_DB), top)
