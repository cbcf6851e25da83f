"""Transfer vectors over frequency with their estimated error."""

from typing import Final

import numpy as np
import xarray as xr

from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Line, Panel, frequency_axis
from ..charts.needs import needs
from .maps import dof_title, names, silent_dofs, silent_panel, unit_level_db

CURVE_DEPTH_DB: Final = 100.0
"""Curves are cut off this far below the loudest of their panel."""
_HEIGHT: Final = 2.4


@needs("transfer_vector", from_="`radiate` and `run`")
def transfer_vectors(radiated: xr.Dataset) -> Chart:
    """Level at every microphone over frequency at 1 mm/s or 1 mrad/s, dB: a panel a motion.

    The estimated error of the grids is drawn as a band.

    Parameters
    ----------
    radiated : of `radiate` or `run`; needs `transfer_vector` (receiver, dof, frequency), Pa s/m
    """
    dims = ("dof", "receiver", "frequency")
    field, error = radiated["transfer_vector"].transpose(*dims), None
    if "transfer_vector_error" in radiated:
        error = radiated["transfer_vector_error"].transpose(*dims)
    dofs = names(field, "dof")
    silent = silent_dofs(field.values, dofs)
    shaded = "" if error is None else " Band: plus and minus the estimated error of the grids."
    panels = (
        silent_panel(dof_title(dof), _HEIGHT)
        if dof in silent
        else _panel(field.sel(dof=dof), None if error is None else error.sel(dof=dof))
        for dof in dofs
    )
    return Chart(
        "transfer_vectors",
        "Sound pressure level at every microphone per unit velocity of the housing against "
        "frequency, a panel per degree of freedom.",
        "Level at every microphone when the housing moves at 1 mm/s or turns at 1 mrad/s (root "
        f"mean square) in one degree of freedom.{shaded}",
        tuple(panels),
        columns=2,
        wide=True,
    )


def _panel(field: xr.DataArray, error: xr.DataArray | None) -> Panel:
    """Curves of one degree of freedom, (receiver, frequency)."""
    curves, frequency = [], field["frequency"].values
    for name, values in zip(names(field, "receiver"), field, strict=True):
        size, around = np.abs(values.values), None
        if error is not None:
            gap = error.sel(receiver=name).values
            ends = (np.maximum(size - gap, 1e-3 * size), size + gap)
            around = (unit_level_db(ends[0]), unit_level_db(ends[1]))
        curves.append(Line(frequency, unit_level_db(size), wrapped(name, 24), around))
    level = unit_level_db(field.values)
    top, lowest = float(level.max()), float(level.min())
    limits = (max(lowest, top - CURVE_DEPTH_DB) - 2.0, top + 4.0)
    x, y = frequency_axis("Frequency, Hz", frequency), Axis("Level, dB re 20 µPa", limits=limits)
    return Panel(x, y, tuple(curves), dof_title(str(field["dof"].item())), _HEIGHT)
