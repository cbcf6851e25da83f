"""The stop of the machine over time, and the order map of its run-down."""

from typing import Final

import numpy as np
import xarray as xr

from ...base.decibel import level_of_amplitude
from ...results.stored_study import catalogue_receiver, speeds
from ..charts.axes import level_image
from ..charts.layout import shortened
from ..charts.marks import Axis, Chart, Panel, lines
from ..charts.needs import needs
from ..shown_speeds import few_speeds

LEVEL_RANGE_DB: Final = 40.0


def force_and_moments(results: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Resultant force, tilting moment and size of the roll moment, (speed, stopping_time)."""
    force, moment = results["stopping_force"], results["stopping_moment"]
    tilting = moment.sel(axis=["x", "y"]).reduce(np.linalg.norm, "axis")
    return force.reduce(np.linalg.norm, "axis"), tilting, abs(moment.sel(axis="z", drop=True))


@needs("stopping_force", from_="`run` of a study with operation.stopping")
def stopping(results: xr.Dataset) -> Chart:
    """The stop over time: speed, rpm, force, N, moments, N m, and Fast level, dB(A).

    A line a speed (six at most); the level is that at the catalogue's microphone.

    Parameters
    ----------
    results : results of `run`; needs `stopping_force` (speed, axis, stopping_time), N, and its like
    """
    results, receiver = few_speeds(results), catalogue_receiver(results)
    force, tilting, roll = force_and_moments(results)
    level = results["stopping_fast_level"].sel(receiver=receiver)
    top = float(level.max())
    curves = {
        Axis("Speed, rpm"): results["stopping_shaft_speed"] * 30.0 / np.pi,
        Axis("Force, N"): force,
        Axis("Tilting\nmoment, N m"): tilting,
        Axis("Roll\nmoment, N m"): roll,
        Axis("Fast level,\ndB(A)", limits=(top - LEVEL_RANGE_DB, top + 3.0)): level,
    }
    names = [f"{speed:g} rpm" for speed in speeds(results)]
    milliseconds = 1e3 * results["stopping_time"].values
    panels = tuple(
        Panel(
            Axis("Time from switch-off, ms" if y.limits else ""),
            y,
            lines(milliseconds, zip(names, curve.transpose("speed", ...).values, strict=True)),
            height=1.6,
        )
        for y, curve in curves.items()
    )
    return Chart(
        "stopping",
        f"Speed, force, moments and A-weighted Fast level at {receiver} over the time around "
        "switch-off; the largest values are in the tables.",
        "Switch-off at 0 ms: speed of the shaft, resultant force and moments on the housing, "
        f"A-weighted Fast level at {shortened(receiver)}.",
        panels,
    )


@needs("stopping_order_map", from_="`run` of a study with operation.stopping")
def stopping_order_map(results: xr.Dataset) -> Chart:
    """Force along x by shaft order over the falling speed of a stop without gas load, dB re 1 N.

    Parameters
    ----------
    results : results of `run`; needs `stopping_order_map` (axis, stopping_block, map_order), N
    """
    along_x = results["stopping_order_map"].sel(axis="x").transpose("stopping_block", "map_order")
    level = level_of_amplitude(along_x.values)
    speed, label = along_x["stopping_block_speed"], "Force along x, dB re 1 N peak"
    image = level_image(along_x["map_order"], speed, level, label)
    return Chart(
        "stopping_order_map",
        "Order map of the force along x over the falling speed of a stop without gas load.",
        "Force along x on the housing by shaft order, over the falling speed of a stop without gas "
        "load.",
        (Panel(Axis("Shaft order", integer=True), Axis("Speed, rpm"), (image,), height=3.0),),
    )
