"""Figures that the machine, its sources and the options report."""

import numpy as np
import xarray as xr

from ....results import labels
from ....results.stored_study import words
from ...tables import DataTable, columns_of


def figures_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return every reported figure by option and speed."""
    known = words(results)
    figures = results["reported_figure"].transpose("option", "figure", "speed")
    rows = [
        (
            option,
            name,
            labels.name(name, known),
            labels.unit(name, known) or "1",
            speed,
            float(figures.values[at]),
        )
        for at in map(tuple, np.argwhere(np.isfinite(figures.values)))
        for option, name, speed in [
            tuple(figures[dim].values[k].item() for dim, k in zip(figures.dims, at, strict=True))
        ]
    ]
    head = ("option", "figure", "words", "unit", "speed_rpm", "value")
    return {"figures.csv": columns_of(head, rows)}
