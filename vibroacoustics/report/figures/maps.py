"""Levels at unit velocity, and levels on a plane."""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ...base.arrays import Array, ComplexArray
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import amplitude_of_level, level_of_amplitude
from ...base.vocabulary import REFERENCE_OPTION
from ...results.labels import DOF_WORDS
from ..charts.needs import needs
from ..shown_speeds import few_speeds
from .style import Picture, plain, png, render

WIDE_INCH: Final = 8.0
"""1280 pixels: these figures have panels side by side."""
COLOUR_MAP: Final = "viridis"
DEPTH_DB: Final = 40.0
"""What lies further below the loudest is the same colour, or the middle of a balloon."""
SILENT_DB: Final = 60.0
"""A motion whose sound stays this far below the loudest of its unit counts as silent."""
UNIT_VELOCITY: Final = 1e-3
"""1 mm/s or 1 mrad/s, root mean square."""


def unit_level_db(pressure_per_velocity: ComplexArray | Array) -> Array:
    """Level at 1 mm/s or 1 mrad/s, dB re 20 µPa; both root mean squares, so no factor of √2."""
    ratio = UNIT_VELOCITY * np.abs(pressure_per_velocity) / REFERENCE_PRESSURE_PA
    return np.asarray(level_of_amplitude(ratio))


def unit_words(dof: str) -> str:
    """The velocity that levels of a degree of freedom hold at."""
    return "1 mrad/s" if dof.startswith("r") else "1 mm/s"


def dof_title(dof: str) -> str:
    """What moves and how fast, as the head of a panel."""
    words = DOF_WORDS.get(dof)
    return f"{dof}: {words}, {unit_words(dof)}" if words else f"{dof}, {unit_words(dof)}"


def names(field: xr.DataArray, dim: str) -> list[str]:
    """Labels of a dimension."""
    return [str(name) for name in field[dim].values]


def rows_of(items: Sequence[object], columns: int) -> int:
    """Rows that the items fill."""
    return max(1, -(-len(items) // columns))


def silent_dofs(field: ComplexArray, dofs: Sequence[str]) -> list[str]:
    """Those far below the loudest of the same unit; field (dof, ...)."""
    size = np.nanmax(np.abs(field).reshape(len(dofs), -1), axis=1)
    silent = []
    for unit in sorted({unit_words(dof) for dof in dofs}):
        same = [index for index, dof in enumerate(dofs) if unit_words(dof) == unit]
        floor = amplitude_of_level(-SILENT_DB) * size[same].max()
        silent += [dofs[index] for index in same if size[index] <= floor]
    return [dof for dof in dofs if dof in silent]


def write_silent(axes: Axes) -> None:
    """Say in an empty panel that it is meant to be empty."""
    axes.text(0.5, 0.5, "no sound here", transform=axes.transAxes, ha="center", va="center")


def colour_edges(highest_db: float, lowest_db: float) -> Array:
    """Edges of bands of 1 or 2 dB, whole multiples, from the loudest down to at most DEPTH_DB."""
    lowest_db = max(lowest_db, highest_db - DEPTH_DB)
    step = 1.0 if highest_db - lowest_db <= DEPTH_DB / 2.0 else 2.0
    low, high = np.floor(lowest_db / step), np.ceil(highest_db / step)
    return np.asarray(step * np.arange(low, max(high, low + 1) + 1))


class Plane(NamedTuple):
    """Points of a map, (row, column) each, m, and what its axes are called."""

    horizontal: Array
    vertical: Array
    horizontal_label: str
    vertical_label: str


@needs("map_transfer_vector", from_="`radiate` of a study with a table radiation.map")
def unit_level_map(radiated: xr.Dataset) -> Figure:
    """Level on a plane at 1 mm/s or 1 mrad/s, dB, at the highest 1x line: a panel a motion.

    Parameters
    ----------
    radiated : of `radiate`; needs `map_transfer_vector`
        (map_row, map_column, dof, line_frequency), Pa s/m

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> radiated = va.open_results("transfer_vectors.nc")
    >>> va.plot.unit_level_map(radiated).savefig("unit_level_map.png")
    """
    field = radiated["map_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "map_row", "map_column")
    dofs = names(field, "dof")
    silent = silent_dofs(field.values, dofs)
    panels = {dof_title(dof): unit_level_db(field.values[i]) for i, dof in enumerate(dofs)}
    return level_maps(panels, _plane(radiated), [dof_title(dof) for dof in silent])


def map_figure(radiated: xr.Dataset) -> Picture:
    """Level on the map per degree of freedom at unit velocity, at the highest line frequency."""
    frequency = float(radiated["line_frequency"][-1])
    return Picture(
        "map",
        f"Sound pressure level on a plane at {frequency:.1f} Hz for motion in each degree of "
        "freedom; the blank area is the machine and its near surroundings.",
        f"Level on the plane at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns at "
        "1 mrad/s (root mean square) in one degree of freedom; coordinates from the centre "
        f"of mass. Blank: the box around the machine. Darkest: {DEPTH_DB:g} dB and more below the "
        "loudest of the row.",
        png(unit_level_map(radiated)),
    )


@needs("map_level", from_="`run` of a study with a table radiation.map")
def line_map(results: xr.Dataset) -> Figure:
    """Level of the 1x line without a balancer on a plane, dB: a panel a speed (six at most).

    Parameters
    ----------
    results : of `run`; needs `map_level` (speed, option, map_row, map_column), dB

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.line_map(results).savefig("line_map.png")
    """
    level = few_speeds(results)["map_level"].sel(option=REFERENCE_OPTION)
    panels = {f"{speed:g} rpm": level.sel(speed=speed).values for speed in level["speed"].values}
    return level_maps(panels, _plane(results), [])


def line_map_figures(results: xr.Dataset) -> list[Picture]:
    """Level of the 1x line of option `none` on the map, by speed shown; nothing without a map."""
    if "map_level" not in results:
        return []
    return [
        Picture(
            "line_map",
            "Sound pressure level of the 1x line on a plane, one panel a speed.",
            "Level of the 1x line on the plane, option none, by speed; coordinates from the centre "
            "of mass. Blank: the box around the machine, and what lies behind a wall.",
            png(line_map(results)),
        )
    ]


def level_maps(panels: dict[str, Array], plane: Plane, silent: Sequence[str]) -> Figure:
    """Level maps, three in a row; the panels of a row share one scale of colours.

    Parameters
    ----------
    panels : level (row, column), dB, by title; NaN is left blank
    plane : the points
    silent : titles of the panels that hold no sound
    """
    columns = min(3, len(panels))
    titles = list(panels)
    rows = rows_of(titles, columns)
    wide = np.ptp(plane.horizontal) / max(float(np.ptp(plane.vertical)), 1e-9)
    panel_width = (WIDE_INCH - 1.2) / columns
    height = rows * (min(panel_width / wide, 6.0) + 0.55) + 0.3

    def paint(figure: Figure) -> None:
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for row, axes_row in enumerate(grid):
            row_titles = titles[row * columns : (row + 1) * columns]
            loud = [panels[title] for title in row_titles if title not in silent]
            if not loud:
                edges = np.array([0.0, 1.0])
            else:
                edges = colour_edges(float(np.nanmax(loud)), float(np.nanmin(loud)))
            for axes, title in zip(axes_row, row_titles, strict=False):
                _map_panel(axes, panels[title], plane, edges, title, title in silent)
            for axes in axes_row[len(row_titles) :]:
                axes.set_axis_off()
            if loud:
                _colour_bar(figure, list(axes_row), edges)
            axes_row[0].set_ylabel(plane.vertical_label)
        for axes in grid[-1]:
            axes.set_xlabel(plane.horizontal_label)

    return render(WIDE_INCH, height, paint)


def _map_panel(
    axes: Axes, level: Array, plane: Plane, edges: Array, title: str, silent: bool
) -> None:
    axes.set_title(plain(title), loc="left")
    axes.set_aspect("equal")
    axes.set_facecolor("#e6e6e6")  # what is left blank
    axes.grid(False)
    axes.set_xlim(plane.horizontal.min(), plane.horizontal.max())
    axes.set_ylim(plane.vertical.min(), plane.vertical.max())
    if silent:
        write_silent(axes)
        return
    shown = np.maximum(level, edges[0])  # NaN stays and is left blank
    where = (plane.horizontal, plane.vertical)
    axes.contourf(*where, shown, levels=edges, cmap=COLOUR_MAP, extend="neither")
    lines = axes.contour(*where, shown, levels=_contours(edges), colors="white", linewidths=0.7)
    axes.clabel(lines, fmt="%.0f", fontsize=7.5)
    blank = np.isnan(level).astype(float)
    if blank.any():
        axes.contour(*where, blank, levels=[0.02], colors="black", linewidths=0.9)


def _contours(edges: Array) -> Array:
    """Round levels inside the scale: few enough to be labelled."""
    span = edges[-1] - edges[0]
    step = next((step for step in (10.0, 5.0, 2.0) if span >= 2.5 * step), 1.0)
    first = step * np.floor(edges[0] / step + 1.0)
    return np.asarray(np.arange(first, edges[-1] - 1e-9, step))


def _colour_bar(figure: Figure, axes: list[Any], edges: Array) -> None:
    bar = figure.colorbar(
        ScalarMappable(BoundaryNorm(edges, 256), COLOUR_MAP), ax=axes, pad=0.02, aspect=18
    )
    bar.ax.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    bar.set_label("dB re 20 µPa")


def _plane(radiated: xr.Dataset) -> Plane:
    """The two axes along which a map extends; the third is constant."""
    coordinates = {name: radiated[f"map_{name}"].values for name in "xyz"}
    normal = min(coordinates, key=lambda name: float(np.ptp(coordinates[name])))
    across, up = [name for name in "xyz" if name != normal]
    return Plane(coordinates[across], coordinates[up], f"{across}, m", f"{up}, m")
