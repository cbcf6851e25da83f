"""The machine in a room: level over the plane of the listeners' ears, both methods at the seam."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ...results.stored_study import parameters
from ..charts.needs import needs
from ..titles import chosen
from .maps import COLOUR_MAP
from .style import (
    WIDTH_INCH,
    Picture,
    draw,
    legend_below,
    line_looks,
    plain,
    png,
    render,
    shortened,
)

_MAP_HEIGHT_INCH = 4.0
_SEAM_HEIGHT_INCH = 1.7


@needs("room_map_level", from_="`run` of a study with a table room")
def room_map(results: xr.Dataset) -> Figure:
    """A-weighted level of the machine over a plane of the room, with furniture and listeners.

    Parameters
    ----------
    results : of `run`; needs `room_map_level` (room_map_y, room_map_x), dB

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> results = va.open_results("kitchen.nc")
    >>> va.plot.room_map(results).savefig("room_map.png")
    """
    level, room = results["room_map_level"], parameters(results)["room"]

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.grid(False)
        axes.set_aspect("equal")
        axes.set_facecolor("#e6e6e6")
        shown = level.transpose("room_map_y", "room_map_x").values
        mesh = axes.pcolormesh(
            level["room_map_x"], level["room_map_y"], shown, cmap=COLOUR_MAP, shading="nearest"
        )
        bar = figure.colorbar(mesh, ax=axes, pad=0.02, aspect=18, location="bottom")
        bar.set_label("dB(A) re 20 µPa")
        _furnish(axes, room, float(level.attrs["height_m"]))
        axes.set(xlim=(0.0, room["size_m"][0]), ylim=(0.0, room["size_m"][1]))
        axes.set(xlabel="x, m", ylabel="y, m")

    return render(WIDTH_INCH, _MAP_HEIGHT_INCH, paint)


def _furnish(axes: Axes, room: dict[str, Any], height_m: float) -> None:
    """Outlines of furniture, dashed where it is not in the plane; machine and listeners."""
    for block in room["furniture"].values():
        low, high = block["lower_m"], block["upper_m"]
        cut = low[2] <= height_m <= high[2]
        axes.add_patch(
            Rectangle(
                (low[0], low[1]), high[0] - low[0], high[1] - low[1],
                fill=False, edgecolor="black", linestyle="-" if cut else ":", linewidth=0.9,
            )
        )  # fmt: skip
    axes.plot(*room["foot_m"], "X", color="white", markeredgecolor="black", markersize=9)
    for name, one in room["listeners"].items():
        axes.plot(one["x_m"], one["y_m"], "o", color="white", markeredgecolor="black")
        axes.annotate(
            shortened(name, 16), (one["x_m"], one["y_m"]), xytext=(5, 4),
            textcoords="offset points", color="white", fontsize=8.5,
        )  # fmt: skip


@needs("room_gain_waves", from_="`run` of a study with a table room")
def room_seam(results: xr.Dataset, listener: str | None = None) -> Figure:
    """Level at a listener over the sound power level, by waves and by the diffuse field.

    Parameters
    ----------
    results : of `run`; needs `room_gain_waves` and `room_gain_diffuse` (listener, seam_band), dB
    listener : in the room; the first where none is named

    Raises
    ------
    ParameterError
        The dataset holds none, or no such listener.

    Examples
    --------
    >>> results = va.open_results("kitchen.nc")
    >>> va.plot.room_seam(results).savefig("room_seam.png")
    """
    there = results.sel(listener=chosen(results, "listener", listener))
    band = there["seam_band"].values
    ways = {"waves": "room_gain_waves", "direct sound and diffuse field": "room_gain_diffuse"}

    def paint(panels: Any) -> None:
        upper, lower = panels
        for (words, name), look in zip(ways.items(), line_looks(len(ways)), strict=True):
            upper.plot(band, there[name], marker="o", label=words, **look)
        upper.set_ylabel("dB")
        upper.set_title(plain("Level at the listener over the power level"), loc="left")
        lower.axhspan(-2.0, 2.0, color="0.5", alpha=0.2, lw=0)
        lower.plot(band, there["room_gain_difference"], "ko-")
        lower.plot(band, there["room_place_gain"], "k--")
        lower.set_title("Difference and, dashed, its mean over listeners; grey: 2 dB", loc="left")
        lower.set_ylabel("dB")
        lower.set(xlabel="third octave, Hz", xscale="log")
        lower.set_xticks(band, [f"{one:g}" for one in band])
        lower.minorticks_off()
        legend_below(upper)

    return draw(2, _SEAM_HEIGHT_INCH, paint, legend_rows=1, sharex=True)


def room_pictures(results: xr.Dataset, listener: str) -> tuple[Picture, ...]:
    """Map and seam."""
    level = results["room_map_level"]
    highest, speed = float(level.attrs["highest_band_hz"]), float(level.attrs["speed_rpm"])
    height = float(level.attrs["height_m"])
    span = np.nanmax(level.values) - np.nanmin(level.values)
    return (
        Picture(
            "room_map",
            f"Level over the room, which spans {span:.0f} dB.",
            f"A-weighted level {height:.3g} m above the floor at {speed:g} rpm, option none: a "
            "monopole of the machine's power at its place, by waves, in third octaves to "
            f"{highest:g} Hz. Cross: machine; dots: listeners; dotted: furniture below or above; "
            "grey: inside furniture.",
            png(room_map(results)),
        ),
        Picture(
            "room_seam",
            "Both methods around the frequencies where one follows the other, and their difference",
            f"{listener}: both methods where one follows the other, of a machine that shakes along "
            "x, y and z with equal powers; the diffuse field is that of the power in the open.",
            png(room_seam(results, listener)),
        ),
    )
