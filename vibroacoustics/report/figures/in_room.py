"""The machine in a room: level over a plane at ear height, and both methods at the crossover."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from ...results.stored_study import parameters
from ...results.titles import chosen
from ..charts.axes import ticks_at
from ..charts.layout import shortened
from ..charts.marks import Area, Axis, Chart, Image, Line, Mark, Note, Panel, Points, Span
from ..charts.needs import needs


@needs("room_map_level", from_="`run` of a study with a table room")
def room_map(results: xr.Dataset) -> Chart:
    """A-weighted level of the machine over a plane of the room, with furniture and listeners.

    Parameters
    ----------
    results : results of `run`; needs `room_map_level` (room_map_y, room_map_x), dB
    """
    level, room = results["room_map_level"], parameters(results)["room"]
    shown = level.transpose("room_map_y", "room_map_x").values
    scale = (float(np.nanmin(shown)), float(np.nanmax(shown)))
    x, y = (
        Axis(f"{name}, m", limits=(0.0, room["size_m"][number])) for number, name in enumerate("xy")
    )
    image = Image(level["room_map_x"], level["room_map_y"], shown, scale, "dB(A) re 20 µPa")
    height, speed = (float(level.attrs[name]) for name in ("height_m", "speed_rpm"))
    return Chart(
        "room_map",
        f"Level over the room, which spans {scale[1] - scale[0]:.0f} dB.",
        f"A-weighted level {height:.3g} m above the floor at {speed:g} rpm, option none. "
        "Wave field of a monopole with the machine's power at its position, third octaves to "
        f"{float(level.attrs['highest_band_hz']):g} Hz. Cross: machine; dots: listeners; dotted: "
        "furniture below or above; grey: inside furniture.",
        (Panel(x, y, (image, *_furniture(room, height)), height=4.0, equal=True),),
    )


def _furniture(room: dict[str, Any], height_m: float) -> Iterator[Mark]:
    """Outlines of furniture, dotted where it is not in the plane; machine and listeners."""
    for block in room["furniture"].values():
        low, high = block["lower_m"], block["upper_m"]
        dash = "-" if low[2] <= height_m <= high[2] else ":"
        x, y = (low[0], high[0], high[0], low[0]), (low[1], low[1], high[1], high[1])
        yield Area(x, y, colour="#000000", dash=dash)
    white = "#ffffff"
    x, y = room["foot_m"][:2]
    yield Points([x], [y], colour="#000000", marker="X", size=13.0)
    yield Points([x], [y], colour=white, marker="X", size=9.0)
    for name, listener in room["listeners"].items():
        x, y = listener["x_m"], listener["y_m"]
        yield Points([x], [y], colour=white, marker="o")
        yield Points([x], [y], colour="#000000", marker="o", filled=False)
        yield Note(x, y, shortened(name, 16), white, shift=(5.0, 4.0), size=8.5)


@needs("room_gain_waves", from_="`run` of a study with a table room")
def room_seam(results: xr.Dataset, listener: str | None = None) -> Chart:
    """Level at a listener relative to the power level, by waves and by the diffuse field.

    Parameters
    ----------
    results : results of `run`; needs `room_gain_waves` and `room_gain_diffuse` (listener,
        seam_band), dB
    listener : in the room; the first where none is named
    """
    name = chosen(results, "listener", listener)
    of_listener = results.sel(listener=name)
    band = of_listener["seam_band"].values
    ends = (float(band.min()) / 1.05, float(band.max()) * 1.05)
    axis = Axis("Third octave, Hz", "log", ends, ticks_at(band))
    gains = (
        Line(band, of_listener["room_gain_waves"], "waves", marker="o"),
        Line(band, of_listener["room_gain_diffuse"], "direct sound and diffuse field", marker="o"),
    )
    differences = (
        Span(-2.0, 2.0, colour="#808080", along="y"),
        Line(band, of_listener["room_gain_difference"], colour="#000000", dash="-", marker="o"),
        Line(band, of_listener["room_place_gain"], colour="#000000", dash="--"),
    )
    mean = "Difference and, dashed, its mean over listeners; grey: 2 dB"
    return Chart(
        "room_seam",
        "Both methods near the crossover frequency, and their difference",
        f"{name}: both methods near the crossover frequency, for a machine that shakes along x, y "
        "and z with equal powers. The diffuse field is that of the power in the open.",
        (
            Panel(axis, Axis("dB"), gains, "Level at the listener re power level", 2.1),
            Panel(axis, Axis("dB"), differences, mean, 2.1),
        ),
    )
