"""Order spectra of the options side by side: force, foot force, sound pressure level."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base import rounding
from ...results.stored_study import catalogue_receiver, options, speeds
from ..charts.needs import needs
from ..shown_speeds import few_speeds
from ..titles import chosen
from .panels import each_panel, in_rpm, named_rows
from .style import COLOURS, MARKERS, Picture, logarithmic_ticks, png

HIGHEST_ORDER: Final = 4
LOWEST_FORCE_N: Final = 1e-3
"""Smaller forces are left out: a thousandth of a newton moves nothing."""


@needs("force_amplitude")
def force_orders(results: xr.Dataset) -> Figure:
    """Resultant force of orders 1 to 4, peak, N: a row an option, a panel a speed (six at most).

    Parameters
    ----------
    results : of `run`; needs `force_amplitude` (speed, option, order), N

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.force_orders(results).savefig("force_orders.png")
    """
    return _dots(few_speeds(results)["force_amplitude"], "Force, N", LOWEST_FORCE_N, True)


@needs("foot_force_amplitude")
def foot_force_orders(results: xr.Dataset) -> Figure:
    """Largest force into a foot of orders 1 to 4, peak, N: a row an option, a panel a speed.

    Parameters
    ----------
    results : of `run`; needs `foot_force_amplitude` (speed, option, foot, order), N

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.foot_force_orders(results).savefig("foot_force_orders.png")
    """
    feet = few_speeds(results)["foot_force_amplitude"].max("foot")
    return _dots(feet, "Force into a foot, N", LOWEST_FORCE_N, True)


@needs("order_level")
def level_orders(results: xr.Dataset, receiver: str | None = None) -> Figure:
    """Sound pressure level of orders 1 to 4, dB, unweighted: a row an option, a panel a speed.

    Parameters
    ----------
    results : of `run`; needs `order_level` (speed, option, receiver, order, weighting), dB
    receiver : one of the results' microphones; default: that of the catalogue's noise

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.level_orders(results).savefig("level_orders.png")
    """
    at = chosen(results, "receiver", receiver or catalogue_receiver(results))
    line = few_speeds(results)["order_level"].sel(receiver=at, weighting="Z")
    return _dots(line, "Level, dB re 20 µPa", rounding.LEVEL_FLOOR_DB, False)


def order_figures(results: xr.Dataset) -> list[Picture]:
    """One figure per quantity: a row per option, a marker per order, a panel per speed shown."""
    receiver, floor_db = catalogue_receiver(results), rounding.LEVEL_FLOOR_DB
    return [
        _force_picture(force_orders(results), "force_orders", "Resultant force"),
        _force_picture(foot_force_orders(results), "foot_force_orders", "Largest foot force"),
        Picture(
            "level_orders",
            f"Sound pressure level of orders 1 to {HIGHEST_ORDER} at {receiver} for every option "
            "and speed; the values of orders 1 and 2 are in the comparison table.",
            f"Sound pressure level of each order at {receiver}, dB re 20 µPa, unweighted. "
            f"Orders below {rounding.fixed(floor_db, 0)} dB are silent and not drawn.",
            png(level_orders(results)),
        ),
    ]


def _force_picture(figure: Figure, name: str, title: str) -> Picture:
    return Picture(
        name,
        f"{title} at orders 1 to {HIGHEST_ORDER} for every option and speed; the values of order "
        "1 are in the comparison table.",
        f"{title} by order, semi-major axis, peak, logarithmic. Orders below "
        f"{LOWEST_FORCE_N:g} N are not drawn.",
        png(figure),
    )


def _dots(values: xr.DataArray, label: str, lowest: float, logarithmic: bool) -> Figure:
    """Dot plot of an amplitude or a level over (speed, option, order)."""
    audible = values.sel(order=slice(1, HIGHEST_ORDER)).transpose("speed", "option", "order")
    data = np.where(audible.values >= lowest, audible.values, np.nan)
    labelled = audible.to_dataset(name="value")
    names, shafts = options(labelled), speeds(labelled)

    def paint(axes: Axes, shaft: float) -> None:
        by_order = zip(audible["order"].values, data[shafts.index(shaft)].T, strict=True)
        for index, (order, sizes) in enumerate(by_order):
            axes.plot(
                sizes, range(len(names)), MARKERS[index % len(MARKERS)], markersize=6,
                color=COLOURS[(0, 1, 3, 5)[index % 4]], label=f"{int(order)}×",
            )  # fmt: skip
        named_rows(axes, names)
        if logarithmic:
            axes.set_xscale("log")
            logarithmic_ticks(axes)

    height = 0.7 + 0.26 * len(names)
    return each_panel(shafts, height, paint, label, title=in_rpm, columns=4, rows=1, sharex=True)
