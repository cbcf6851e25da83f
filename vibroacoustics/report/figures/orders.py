"""The force of the options over a revolution, and order spectra side by side."""

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import catalogue_receiver, options, speeds, words
from ...results.titles import chosen
from ..charts.axes import option_panel
from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Panel, Points, lines
from ..charts.needs import needs
from ..shown_speeds import few_speeds


@needs("force", from_="`run` (above 100 speeds with operation.keep_time_series)")
def force_over_revolution(results: xr.Dataset, speed_rpm: float | None = None) -> Chart:
    """Force on the housing over crank angle: a panel an axis, a line an option.

    Parameters
    ----------
    results : results of `run`; needs `force` (speed, option, source, axis, crank_angle), N
    speed_rpm : one of the results' speeds; default: the highest
    """
    speed = max(speeds(results)) if speed_rpm is None else chosen(results, "speed", speed_rpm)
    total = results["force"].sel(speed=speed).sum("source").transpose("axis", "option", ...)
    names = [wrapped(name, 24) for name in options(results)]
    degrees = np.rad2deg(results["crank_angle"].values)
    angles = tuple((float(angle), str(angle)) for angle in range(0, 361, 60))
    x, peak = Axis("Crank angle, degrees", "linear", (0.0, 360.0), angles), float(abs(total).max())
    panels = tuple(
        Panel(
            x,
            Axis(f"Along {along['axis'].item()}, N", limits=(-1.05 * peak, 1.05 * peak)),
            lines(degrees, zip(names, along.values, strict=True)),
            height=2.0,
        )
        for along in total
    )
    return Chart(
        "force_over_revolution",
        f"Resultant force along x, y and z over one revolution at {speed:g} rpm for every option; "
        f"the largest force is {peak:.3g} N.",
        f"Resultant force on the housing over one revolution at {speed:g} rpm, along "
        f"{words(results)['axes']}. All three on one scale; lines that coincide are dashed "
        "differently.",
        panels,
    )


HIGHEST_ORDER: Final = 4
"""Highest order of forces that is shown: that of the balance of masses."""
MOST_ORDERS: Final = 8
"""Orders of the level that are shown, apart from 1×."""
LOWEST_FORCE_N: Final = 1e-3
"""Smaller forces are not drawn: a thousandth of a newton moves nothing."""


@needs("force_amplitude")
def force_orders(results: xr.Dataset) -> Chart:
    """Resultant force of orders 1 to 4, peak, N: a row an option, a panel a speed (six at most).

    Parameters
    ----------
    results : results of `run`; needs `force_amplitude` (speed, option, order), N
    """
    force = few_speeds(results)["force_amplitude"]
    return _of_force("force_orders", "Resultant force", force, "Force, N")


@needs("foot_force_amplitude")
def foot_force_orders(results: xr.Dataset) -> Chart:
    """Largest force into a foot of orders 1 to 4, peak, N: a row an option, a panel a speed.

    Parameters
    ----------
    results : results of `run`; needs `foot_force_amplitude` (speed, option, foot, order), N
    """
    feet = few_speeds(results)["foot_force_amplitude"].max("foot")
    return _of_force("foot_force_orders", "Largest foot force", feet, "Force into a foot, N")


@needs("order_level")
def level_orders(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted level of 1x and of the eight loudest orders: a row an option, a panel a speed.

    Parameters
    ----------
    results : results of `run`; needs `order_level` (speed, option, receiver, order, weighting), dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    level = few_speeds(results)["order_level"].sel(receiver=mic, weighting="A")
    loud = loudest_orders(level.where(level >= rounding.LEVEL_FLOOR_DB))
    named = ", ".join(f"{order:g}" for order in loud)
    floor_db = rounding.LEVEL_FLOOR_DB
    return Chart(
        "level_orders",
        f"A-weighted level of orders {named} at {mic} for every option and speed.",
        f"A-weighted level of orders {named} at {mic}, dB re 20 µPa. They are 1× and the loudest "
        f"with and without options. Orders below {rounding.fixed(floor_db, 0)} dB are not drawn.",
        _dots(level.sel(order=loud), Axis("Level, dB(A)"), floor_db),
    )


def loudest_orders(level: xr.DataArray) -> list[float]:
    """Return 1 and the orders that carry the sound by level, (option, order, ...), in rising order.

    Half of them are the loudest without an option, the others the loudest of all options.
    """
    ranked = []
    for levels in (level.sel(option=[REFERENCE_OPTION]), level):
        highest = levels.max([dim for dim in level.dims if dim != "order"]).dropna("order")
        ranked.append(highest["order"].values[np.argsort(-highest.values, kind="stable")])
    loud = dict.fromkeys([*ranked[0][: MOST_ORDERS // 2].tolist(), *ranked[1].tolist()])
    return sorted({1.0, *list(loud)[:MOST_ORDERS]})


def _of_force(name: str, title: str, force: xr.DataArray, label: str) -> Chart:
    return Chart(
        name,
        f"{title} at orders 1 to {HIGHEST_ORDER} for every option and speed; the values of order "
        "1 are in the comparison table.",
        f"{title} at orders 1 to {HIGHEST_ORDER}, semi-major axis, peak, logarithmic. Orders below "
        f"{LOWEST_FORCE_N:g} N are not drawn.",
        _dots(force.sel(order=slice(1, HIGHEST_ORDER)), Axis(label, "log"), LOWEST_FORCE_N),
    )


def _dots(values: xr.DataArray, axis: Axis, lowest: float) -> tuple[Panel, ...]:
    """Panels of an amplitude or a level over (speed, option, order), on one scale."""
    shown = values.where(values >= lowest).transpose("speed", "order", "option")
    names = options(shown.to_dataset(name="value"))
    limits = _ends(shown.values, axis.scale == "log")
    x, rows = replace(axis, limits=limits), np.arange(len(names))
    return tuple(
        option_panel(
            x,
            names,
            (Points(sizes, rows, f"{sizes['order'].item():g}×") for sizes in at_speed),
            f"{at_speed['speed'].item():g} rpm",
        )
        for at_speed in shown
    )


def _ends(values: Array, is_log: bool) -> tuple[float, float] | None:
    finite = values[np.isfinite(values)]
    if not finite.size:
        return None
    low, high = float(finite.min()), float(finite.max())
    return (low / 1.3, high * 1.3) if is_log else (low - 2.0, high + 2.0)
