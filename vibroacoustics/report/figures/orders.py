"""Order spectra of the options side by side: force, foot force, sound pressure level."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ...base import rounding
from ...base.arrays import Array
from ..study import catalogue_receiver, few_speeds, options, speeds
from .style import COLOURS, MARKERS, Picture, draw, legend_below, logarithmic_ticks, wrap

HIGHEST_ORDER: Final = 4
LOWEST_FORCE_N: Final = 1e-3
"""Smaller forces are left out: a thousandth of a newton moves nothing."""


def order_figures(results: xr.Dataset) -> list[Picture]:
    """One figure per quantity: a row per option, a marker per order, a panel per speed shown."""
    results, receiver = few_speeds(results), catalogue_receiver(results)
    feet = results["foot_force_amplitude"].max("foot")
    line = results["order_level"].sel(receiver=receiver, weighting="Z")
    floor_db = rounding.LEVEL_FLOOR_DB
    return [
        _force_picture(results["force_amplitude"], "force_orders", "Resultant force", "Force, N"),
        _force_picture(feet, "foot_force_orders", "Largest foot force", "Force into a foot, N"),
        Picture(
            "level_orders",
            f"Sound pressure level of orders 1 to {HIGHEST_ORDER} at {receiver} for every option "
            "and speed; the values of orders 1 and 2 are in the comparison table.",
            f"Sound pressure level of each order at {receiver}, dB re 20 µPa, unweighted. "
            f"Orders below {rounding.fixed(floor_db, 0)} dB are silent and not drawn.",
            _dots(line, "Level, dB re 20 µPa", floor_db, logarithmic=False),
        ),
    ]


def _force_picture(values: xr.DataArray, name: str, title: str, axis: str) -> Picture:
    return Picture(
        name,
        f"{title} at orders 1 to {HIGHEST_ORDER} for every option and speed; the values of order "
        "1 are in the comparison table.",
        f"{title} by order, semi-major axis, peak, logarithmic. Orders below "
        f"{LOWEST_FORCE_N:g} N are not drawn.",
        _dots(values, axis, LOWEST_FORCE_N, logarithmic=True),
    )


def _dots(values: xr.DataArray, label: str, lowest: float, logarithmic: bool) -> bytes:
    """Dot plot of an amplitude or a level over (speed, option, order)."""
    audible = values.sel(order=slice(1, HIGHEST_ORDER)).transpose("speed", "option", "order")
    data = np.where(audible.values >= lowest, audible.values, np.nan)
    labelled = audible.to_dataset(name="value")
    names, shafts = options(labelled), speeds(labelled)

    def paint(panels: Sequence[Axes]) -> None:
        for axes, shaft, per_option in zip(panels, shafts, data, strict=True):
            _dot_panel(axes, per_option, [int(order) for order in audible["order"].values])
            axes.set_title(f"{shaft:g} rpm", loc="left")
            axes.set_yticks(range(len(names)), [wrap(name) for name in names])
            axes.invert_yaxis()
            if logarithmic:
                axes.set_xscale("log")
                logarithmic_ticks(axes)
        panels[-1].set_xlabel(label)
        legend_below(panels[0], 4)

    height = 0.7 + 0.26 * len(names)
    return draw(len(shafts), height, paint, sharex=True)


def _dot_panel(axes: Axes, per_option: Array, orders: list[int]) -> None:
    rows = np.arange(len(per_option))
    for index, order in enumerate(orders):
        axes.plot(
            per_option[:, index],
            rows,
            linestyle="none",
            marker=MARKERS[index % len(MARKERS)],
            color=COLOURS[(0, 1, 3, 5)[index % 4]],
            markersize=6,
            label=f"{order}×",
        )
