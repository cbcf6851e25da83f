"""Beats of several machines: levels between which each pair of lines rises and falls."""

from typing import Final

import numpy as np
import xarray as xr

from ..charts.axes import level_axis
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Panel, Points, Segments
from ..file_names import numbered

_RANGE_DB: Final = 60.0
_KEY: Final = "Bar: minimum to maximum of the envelope; point: sum of the energies."


def beat_charts(results: xr.Dataset) -> list[Chart]:
    """Return for each common receiver the range of every beat over its frequency.

    Parameters
    ----------
    results : results of several machines together, with beats
    """
    return [
        _chart(results.sel(common_receiver=name), name, file)
        for name, file in numbered(results, "common_receiver")
    ]


def _chart(results: xr.Dataset, receiver: str, file: str) -> Chart:
    hertz = results["beat_frequency"].values
    energy, highest, lowest = (
        results[f"beat_{name}_level"].values for name in ("energy", "highest", "lowest")
    )
    y = level_axis("Level, dB re 20 µPa, unweighted", np.concatenate([energy, highest]), _RANGE_DB)
    bottom = -np.inf if y.limits is None or y.limits[0] is None else y.limits[0]
    marks = (
        Segments(
            hertz, np.maximum(lowest, bottom), hertz, highest, "minimum to maximum",
            COLOURS[3], "-", 4.0,
        ),
        Points(hertz, energy, "sum of the energies", None, COLOURS[1], "o", 4.0),
    )  # fmt: skip
    x = Axis("Beat, Hz", limits=(0.0, 1.05 * max(float(hertz.max()), 0.1)))
    return Chart(
        f"beats_{file}",
        f"Beats at {receiver}: range of the envelope of every pair of lines.",
        f"Beats at {receiver}. {_KEY}",
        (Panel(x, y, marks, shortened(receiver, 60), 2.8),),
    )
