"""Transfer vectors over frequency with their estimated error."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array, ComplexArray
from ..charts.needs import needs
from .maps import (
    WIDE_INCH,
    dof_title,
    names,
    rows_of,
    silent_dofs,
    unit_level_db,
    write_silent,
)
from .style import Picture, frequency_ticks, line_looks, png, render, wrap

CURVE_DEPTH_DB: Final = 100.0
"""Curves are cut off this far below the loudest of their panel."""


@needs("transfer_vector", from_="`radiate` and `run`")
def transfer_vectors(radiated: xr.Dataset) -> Figure:
    """Level at every microphone over frequency at 1 mm/s or 1 mrad/s, dB: a panel a motion.

    The estimated error of the grids is drawn as a band.

    Parameters
    ----------
    radiated : of `radiate` or `run`; needs `transfer_vector` (receiver, dof, frequency), Pa s/m

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> radiated = va.open_results("transfer_vectors.nc")
    >>> va.plot.transfer_vectors(radiated).savefig("transfer_vectors.png")
    """
    field = radiated["transfer_vector"].transpose("dof", "receiver", "frequency")
    error = radiated.get("transfer_vector_error")
    band = None if error is None else error.transpose("dof", "receiver", "frequency").values
    dofs, receivers = names(field, "dof"), names(field, "receiver")
    frequency = field["frequency"].values

    def paint(figure: Figure) -> None:
        panels = figure.subplots(rows_of(dofs, 2), 2, squeeze=False, sharex=True).ravel()
        silent = silent_dofs(field.values, dofs)
        for index, (axes, dof) in enumerate(zip(panels, dofs, strict=False)):
            axes.set_title(dof_title(dof), loc="left")
            if dof in silent:
                axes.set_yticks([])
                write_silent(axes)
                continue
            _level_panel(
                axes, frequency, field.values[index], None if band is None else band[index],
                receivers,
            )  # fmt: skip
        for axes in panels[len(dofs) :]:
            axes.set_axis_off()
        for axes in panels[-2:]:
            axes.set_xlabel("Frequency, Hz")
        for axes in panels[::2]:
            axes.set_ylabel("Level, dB re 20 µPa")
        loudest = next((a for a, d in zip(panels, dofs, strict=False) if d not in silent), None)
        if loudest is not None:
            handles, labels = loudest.get_legend_handles_labels()
            figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)

    return render(WIDE_INCH, 2.1 * rows_of(dofs, 2) + 0.3 * rows_of(receivers, 4) + 0.2, paint)


def transfer_vector_figure(radiated: xr.Dataset) -> Picture:
    """Level over frequency, a panel per degree of freedom, the estimated error as a band."""
    shaded = (
        ""
        if "transfer_vector_error" not in radiated
        else " Band: plus and minus the estimated error of the grids."
    )
    return Picture(
        "transfer_vectors",
        "Sound pressure level at every microphone per unit velocity of the housing against "
        "frequency, a panel per degree of freedom.",
        "Level at every microphone when the housing moves at 1 mm/s or turns at 1 mrad/s (root "
        f"mean square) in one degree of freedom.{shaded}",
        png(transfer_vectors(radiated)),
    )


def _level_panel(
    axes: Axes, frequency: Array, field: ComplexArray, error: Array | None, receivers: Sequence[str]
) -> None:
    """Curves of one degree of freedom, (receiver, frequency)."""
    looks = line_looks(len(receivers))
    for row, (name, look) in enumerate(zip(receivers, looks, strict=True)):
        axes.semilogx(frequency, unit_level_db(field[row]), label=wrap(name, 24), **look)
        if error is not None:
            size = np.abs(field[row])
            axes.fill_between(
                frequency,
                unit_level_db(np.maximum(size - error[row], 1e-3 * size)),
                unit_level_db(size + error[row]),
                color=look["color"],
                alpha=0.25,
                linewidth=0.0,
            )
    top = float(unit_level_db(field).max())
    lowest = float(unit_level_db(field).min())
    axes.set_ylim(max(lowest, top - CURVE_DEPTH_DB) - 2.0, top + 4.0)
    frequency_ticks(axes, frequency)
