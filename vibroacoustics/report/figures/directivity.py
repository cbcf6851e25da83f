"""Levels around the machine: balloons and polar cuts."""

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ...base import rounding
from ...base.arrays import Array
from ..charts.needs import needs
from .maps import (
    COLOUR_MAP,
    DEPTH_DB,
    WIDE_INCH,
    colour_edges,
    dof_title,
    names,
    silent_dofs,
    unit_level_db,
)
from .style import COLOURS, Picture, plain, png, render

RING_STEP_DB: Final = 20.0


@needs(
    "directivity_transfer_vector",
    from_="`radiate` of a study with a table radiation.directivity",
)
def directivity(radiated: xr.Dataset) -> Figure:
    """Balloon and two cuts of each motion that radiates, dB at 1 mm/s or 1 mrad/s.

    At the highest 1x line.

    Parameters
    ----------
    radiated : of `radiate`; needs `directivity_transfer_vector`
        (polar_angle, azimuth, dof, line_frequency), Pa s/m

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> radiated = va.open_results("transfer_vectors.nc")
    >>> va.plot.directivity(radiated).savefig("directivity.png")
    """
    field, silent = _around(radiated)
    dofs, frequency = names(field, "dof"), float(field["line_frequency"])
    balloons = {
        dof_title(dof): unit_level_db(field.values[index])
        for index, dof in enumerate(dofs)
        if dof not in silent
    }
    return directivity_balloons(
        balloons, field["polar_angle"].values, field["azimuth"].values, frequency
    )


def _around(radiated: xr.Dataset) -> tuple[xr.DataArray, list[str]]:
    """Field (dof, polar_angle, azimuth) at the highest frequency, and the silent motions."""
    field = radiated["directivity_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "polar_angle", "azimuth")
    return field, silent_dofs(field.values, names(field, "dof"))


def directivity_figure(radiated: xr.Dataset) -> Picture:
    """Balloon and two cuts of each degree of freedom that radiates, at the highest frequency."""
    field, silent = _around(radiated)
    frequency = float(field["line_frequency"])
    left_out = f" Silent and left out: {', '.join(silent)}." if silent else ""
    return Picture(
        "directivity",
        f"Directivity at {frequency:.1f} Hz: a balloon and two cuts for every degree of freedom "
        "that radiates.",
        f"Level around the machine at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns "
        "at 1 mrad/s (root mean square) in one degree of freedom. Balloon: the radius falls to "
        f"zero {DEPTH_DB:g} dB below the loudest.{left_out}",
        png(directivity(radiated)),
    )


def directivity_balloons(
    levels: dict[str, Array], polar_angle: Array, azimuth: Array, frequency_hz: float
) -> Figure:
    """A row per title: balloon, vertical cuts, horizontal cut.

    Parameters
    ----------
    levels : level (polar angle, azimuth), dB, by title
    polar_angle : from +z, rad
    azimuth : from +x towards +y over a whole turn, its end left out, rad
    frequency_hz : named in the head of the figure
    """
    rows = max(len(levels), 1)

    def paint(figure: Figure) -> None:
        figure.suptitle(f"{frequency_hz:.1f} Hz, level in dB re 20 µPa", x=0.01, ha="left")
        for row, (title, level) in enumerate(levels.items()):
            solid = figure.add_subplot(rows, 3, 3 * row + 1, projection="3d")
            _balloon(figure, solid, level, polar_angle, azimuth)
            solid.set_title(plain(title), loc="left")
            top = 5.0 * float(np.ceil(level.max() / 5.0))
            upright = figure.add_subplot(rows, 3, 3 * row + 2, projection="polar")
            _vertical_cuts(upright, level, polar_angle, azimuth, top)
            flat = figure.add_subplot(rows, 3, 3 * row + 3, projection="polar")
            _horizontal_cut(flat, level, polar_angle, azimuth, top)

    return render(WIDE_INCH, 2.5 * rows + 0.4, paint)


def _balloon(figure: Figure, axes: Any, level: Array, polar_angle: Array, azimuth: Array) -> None:
    closed_level = np.concatenate([level, level[:, :1]], axis=1)
    closed_azimuth = np.append(azimuth, azimuth[0] + 2.0 * np.pi)
    radius = np.clip(closed_level - level.max() + DEPTH_DB, 0.0, None)
    sine = np.sin(polar_angle)[:, None]
    norm = BoundaryNorm(colour_edges(float(level.max()), float(level.min())), 256)
    mapping = ScalarMappable(norm, COLOUR_MAP)
    axes.plot_surface(
        radius * sine * np.cos(closed_azimuth),
        radius * sine * np.sin(closed_azimuth),
        radius * np.cos(polar_angle)[:, None],
        facecolors=mapping.to_rgba(closed_level),
        rstride=1,
        cstride=1,
        linewidth=0.2,
        edgecolor="#00000030",
        shade=False,
    )
    below = bool(polar_angle.max() > np.pi / 2.0 + 1e-9)
    size = DEPTH_DB
    axes.set(xlim=(-size, size), ylim=(-size, size), zlim=(-size if below else 0.0, size))
    axes.set_box_aspect((1.0, 1.0, 1.0 if below else 0.5), zoom=1.4)
    axes.set(xticks=[], yticks=[], zticks=[], xlabel="x", ylabel="y", zlabel="z")
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.labelpad = -14
    bar = figure.colorbar(mapping, ax=axes, orientation="horizontal", pad=0.0, shrink=0.8)
    bar.ax.xaxis.set_major_locator(MaxNLocator(5, integer=True))


def _vertical_cuts(axes: Any, level: Array, polar_angle: Array, azimuth: Array, top: float) -> None:
    """The planes x-z and y-z, drawn with z up."""
    for name, start, colour, dash in (("xz", 0.0, COLOURS[3], "-"), ("yz", 0.5, COLOURS[1], "--")):
        near = _column(azimuth, start * np.pi)
        far = _column(azimuth, (start + 1.0) * np.pi)
        angle = np.concatenate([-polar_angle[::-1], polar_angle])
        curve = np.concatenate([level[::-1, far], level[:, near]])
        axes.plot(angle, np.maximum(curve, top - DEPTH_DB), dash, color=colour, label=name)
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    if polar_angle.max() < np.pi / 2.0 + 1e-9:
        axes.set_thetalim(-np.pi / 2.0, np.pi / 2.0)
    _decibel_rings(axes, top)
    axes.set_rlabel_position(-90.0)
    axes.set_xticks(np.deg2rad([-90, -60, -30, 0, 30, 60, 90]))
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, -0.16), ncols=2, frameon=False)


def _horizontal_cut(
    axes: Any, level: Array, polar_angle: Array, azimuth: Array, top: float
) -> None:
    """The cone nearest to the horizon, seen from above, x to the right."""
    row = int(np.argmin(np.abs(polar_angle - np.pi / 2.0)))
    angle, curve = np.append(azimuth, azimuth[0]), np.append(level[row], level[row, 0])
    axes.plot(angle, np.maximum(curve, top - DEPTH_DB), color=COLOURS[5], label="xy")
    _decibel_rings(axes, top)
    axes.set_rlabel_position(22.5)
    axes.set_xticks(np.deg2rad([0, 45, 90, 135, 180, 225, 270, 315]))
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, -0.3), frameon=False)


def _decibel_rings(axes: Any, top: float) -> None:
    axes.set_ylim(top - DEPTH_DB, top)
    rings = top - RING_STEP_DB * np.arange(DEPTH_DB / RING_STEP_DB)
    axes.set_yticks(rings, [rounding.fixed(float(ring), 0) for ring in rings], fontsize=7.5)
    axes.tick_params(axis="x", labelsize=7.5, pad=-1.0)


def _column(azimuth: Array, wanted: float) -> int:
    return int(np.argmin(np.abs(np.exp(1j * azimuth) - np.exp(1j * wanted))))
