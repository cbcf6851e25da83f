"""The stop of the machine over time, and the order map of its run-down."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.decibel import level_of_amplitude
from ...results.stored_study import catalogue_receiver, speeds
from ..charts.needs import needs
from ..shown_speeds import few_speeds
from ..stopping import force_and_moments
from .panels import each_panel, in_rpm, level_map, lines, one_panel
from .style import Picture, png, shortened, whole_number_ticks

MAP_RANGE_DB: Final = 60.0
LEVEL_RANGE_DB: Final = 40.0
LEVEL: Final = "Fast level, dB(A)"


def stopping_figures(results: xr.Dataset) -> list[Picture]:
    """Course of the stop and order map, as far as the results have them."""
    makers = {"stopping_force": _course, "stopping_order_map": _map}
    return [make(results) for name, make in makers.items() if name in results]


@needs("stopping_force", from_="`run` of a study with operation.stopping")
def stopping(results: xr.Dataset) -> Figure:
    """The stop over time: speed, rpm, force, N, moments, N m, and Fast level, dB(A).

    A line a speed (six at most); the level is that at the catalogue's microphone.

    Parameters
    ----------
    results : of `run`; needs `stopping_force` (speed, axis, stopping_time), N, and its like

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.stopping(results).savefig("stopping.png")
    """
    results, receiver = few_speeds(results), catalogue_receiver(results)
    force, tilting, roll = force_and_moments(results)
    level = results["stopping_fast_level"].sel(receiver=receiver)
    curves = {
        "Speed, rpm": results["stopping_shaft_speed"] * 30.0 / np.pi,
        "Force, N": force,
        "Tilting moment, N m": tilting,
        "Roll moment, N m": roll,
        LEVEL: level,
    }
    names = list(map(in_rpm, speeds(results)))
    milliseconds = 1e3 * results["stopping_time"].values

    def paint(axes: Axes, label: str) -> None:
        lines(axes, milliseconds, names, curves[label].transpose("speed", ...))
        axes.set_ylabel(label)
        if label == LEVEL:
            top = float(level.max())
            axes.set_ylim(top - LEVEL_RANGE_DB, top + 3.0)

    return each_panel(
        list(curves), 1.55, paint, "Time from switch-off, ms", columns=4,
        rows=-(-len(names) // 4), sharex=True,
    )  # fmt: skip


def _course(results: xr.Dataset) -> Picture:
    receiver = catalogue_receiver(results)
    return Picture(
        "stopping",
        f"Speed, force, moments and A-weighted Fast level at {receiver} over the time around "
        "switch-off; the largest values are in the tables.",
        f"Switch-off at 0 ms: speed of the shaft, resultant force and moments on the housing, "
        f"A-weighted Fast level at {shortened(receiver)}.",
        png(stopping(results)),
    )


@needs("stopping_order_map", from_="`run` of a study with operation.stopping")
def stopping_order_map(results: xr.Dataset) -> Figure:
    """Force along x by shaft order over the falling speed of a stop without gas load, dB re 1 N.

    Parameters
    ----------
    results : of `run`; needs `stopping_order_map` (axis, stopping_block, map_order), N

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.stopping_order_map(results).savefig("stopping_order_map.png")
    """
    along_x = results["stopping_order_map"].sel(axis="x").transpose("stopping_block", "map_order")
    level = level_of_amplitude(along_x.values)

    def paint(axes: Axes) -> None:
        speed, label = along_x["stopping_block_speed"], "Force along x, dB re 1 N peak"
        level_map(axes, along_x["map_order"], speed, level, MAP_RANGE_DB, label)
        whole_number_ticks(axes)

    return one_panel(2.8, paint, "Shaft order", "Speed, rpm")


def _map(results: xr.Dataset) -> Picture:
    return Picture(
        "stopping_order_map",
        "Order map of the force along x over the falling speed of a stop without gas load.",
        "Force along x on the housing by shaft order, over the falling speed of a stop without gas "
        "load.",
        png(stopping_order_map(results)),
    )
