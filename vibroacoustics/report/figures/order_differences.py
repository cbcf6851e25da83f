"""How far the orders of two results lie apart."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array
from .needs import needs
from .panels import each_panel
from .style import COLOURS, MARKERS, Picture, png, shortened, whole_number_ticks

_MOST_PANELS: Final = 4
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
