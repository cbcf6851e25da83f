"""Where 1× lies on an axis of frequency."""

import xarray as xr
from matplotlib.axes import Axes

from ...results.stored_study import first_order_hz
from ..shown_speeds import many_speeds


def mark_first_order(axes: Axes, results: xr.Dataset, colour: str, label: str = "") -> None:
    """A dotted line at every speed; where there are many, a band over their range."""
    frequencies = first_order_hz(results)
    if many_speeds(results):
        axes.axvspan(
            frequencies.min(), frequencies.max(), color="#888888", alpha=0.25, lw=0, label=label
        )
        return
    for index, frequency in enumerate(frequencies):
        name = label if index == 0 and label else "_nolegend_"
        axes.axvline(frequency, color=colour, linewidth=0.9, linestyle=":", label=name)


def first_order_marks(results: xr.Dataset) -> str:
    """What the marks are, as the opening of a sentence."""
    return "Grey band" if many_speeds(results) else "Upright dotted lines"
