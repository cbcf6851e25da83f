"""Figures of the sound field alone: transfer vectors with their error, map, directivity."""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from ..constants import REFERENCE_PRESSURE_PA
from . import rounding
from .figures.style import COLOURS, Picture, frequency_ticks, line_looks, plain, render, wrap
from .labels import DOF_WORDS
from .tables import Table, to_text

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

WIDE_INCH: Final = 8.0
"""1280 pixels: these figures have panels side by side."""
COLOUR_MAP: Final = "viridis"
DEPTH_DB: Final = 40.0
"""What lies further below the loudest is the same colour, or the middle of a balloon."""
CURVE_DEPTH_DB: Final = 100.0
"""Curves over frequency are cut off this far below the loudest of their panel."""
RING_STEP_DB: Final = 20.0
SILENT_DB: Final = 60.0
"""A motion whose sound stays this far below the loudest of its unit counts as silent."""
UNIT_VELOCITY: Final = 1e-3
"""1 mm/s or 1 mrad/s, root mean square."""


class Plane(NamedTuple):
    """Points of a map, (row, column) each, m, and what its axes are called."""

    horizontal: Real
    vertical: Real
    horizontal_label: str
    vertical_label: str


def radiation_figures(radiated: xr.Dataset) -> list[Picture]:
    """The figures that the dataset has variables for."""
    makers = {
        "transfer_vector": transfer_vector_figure,
        "map_transfer_vector": map_figure,
        "directivity_transfer_vector": directivity_figure,
    }
    return [make(radiated) for name, make in makers.items() if name in radiated]


def unit_level_db(pressure_per_velocity: Complex | Real) -> Real:
    """Level at 1 mm/s or 1 mrad/s, dB re 20 µPa; both root mean squares, so no factor of √2."""
    ratio = UNIT_VELOCITY * np.abs(pressure_per_velocity) / REFERENCE_PRESSURE_PA
    return np.asarray(20.0 * np.log10(np.maximum(ratio, 1e-15)))


def unit_words(dof: str) -> str:
    """The velocity that levels of a degree of freedom hold at."""
    return "1 mrad/s" if dof.startswith("r") else "1 mm/s"


# --- transfer vectors ----------------------------------------------------------------------------


def transfer_vector_figure(radiated: xr.Dataset) -> Picture:
    """Level over frequency, a panel per degree of freedom, the estimated error as a band."""
    field = radiated["transfer_vector"].transpose("dof", "receiver", "frequency")
    error = radiated.get("transfer_vector_error")
    band = None if error is None else error.transpose("dof", "receiver", "frequency").values
    dofs, receivers = _names(field, "dof"), _names(field, "receiver")
    frequency = field["frequency"].values

    def paint(figure: Figure) -> None:
        panels = figure.subplots(_rows(dofs, 2), 2, squeeze=False, sharex=True).ravel()
        silent = _silent_dofs(field.values, dofs)
        for index, (axes, dof) in enumerate(zip(panels, dofs, strict=False)):
            axes.set_title(_title(dof), loc="left")
            if dof in silent:
                axes.set_yticks([])
                _write_silent(axes)
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

    shaded = "" if band is None else " Band: plus and minus the estimated error of the grids."
    return Picture(
        "transfer_vectors",
        "Sound pressure level at every microphone per unit velocity of the housing against "
        "frequency, a panel per degree of freedom.",
        "Level at every microphone when the housing moves at 1 mm/s or turns at 1 mrad/s (root "
        f"mean square) in one degree of freedom.{shaded}",
        render(WIDE_INCH, 2.1 * _rows(dofs, 2) + 0.3 * _rows(receivers, 4) + 0.2, paint),
    )


def _level_panel(
    axes: Axes, frequency: Real, field: Complex, error: Real | None, receivers: Sequence[str]
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


# --- map -----------------------------------------------------------------------------------------


def map_figure(radiated: xr.Dataset) -> Picture:
    """Level on the map per degree of freedom at unit velocity, at the highest line frequency."""
    field = radiated["map_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "map_row", "map_column")
    dofs = _names(field, "dof")
    frequency = float(field["line_frequency"])
    plane = _plane(radiated)
    silent = _silent_dofs(field.values, dofs)
    panels = {_title(dof): unit_level_db(field.values[i]) for i, dof in enumerate(dofs)}
    quiet = [_title(dof) for dof in silent]
    return Picture(
        "map",
        f"Sound pressure level on a plane at {frequency:.1f} Hz for motion in each degree of "
        "freedom; the blank area is the machine and its near surroundings.",
        f"Level on the plane at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns at "
        "1 mrad/s (root mean square) in one degree of freedom; coordinates from the centre "
        f"of mass. Blank: the box around the machine. Darkest: {DEPTH_DB:g} dB and more below the "
        "loudest of the row.",
        level_maps(panels, plane, quiet),
    )


def line_map_figure(pressure_peak: Complex, plane: Plane, title: str) -> Picture:
    """Level on the map of a field that has been computed, such as the 1x line of one option.

    Parameters
    ----------
    pressure_peak : complex peak pressure (row, column), Pa; NaN inside the box
    plane : the points
    title : what is shown, such as `1x at 2900 rpm, none`
    """
    level = 20.0 * np.log10(
        np.maximum(np.abs(pressure_peak) / np.sqrt(2.0), 1e-20) / REFERENCE_PRESSURE_PA
    )
    return Picture(
        "line_map",
        f"Sound pressure level on a plane: {title}.",
        f"Level on the plane: {title}. Blank: the box around the machine.",
        level_maps({title: level}, plane, []),
    )


def level_maps(panels: dict[str, Real], plane: Plane, silent: Sequence[str]) -> bytes:
    """PNG of level maps, three in a row; the panels of a row share one scale of colours.

    Parameters
    ----------
    panels : level (row, column), dB, by title; NaN is left blank
    plane : the points
    silent : titles of the panels that hold no sound
    """
    columns = min(3, len(panels))
    titles = list(panels)
    rows = _rows(titles, columns)
    wide = np.ptp(plane.horizontal) / max(float(np.ptp(plane.vertical)), 1e-9)
    panel_width = (WIDE_INCH - 1.2) / columns
    height = rows * (min(panel_width / wide, 6.0) + 0.55) + 0.3

    def paint(figure: Figure) -> None:
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for row, axes_row in enumerate(grid):
            own = titles[row * columns : (row + 1) * columns]
            loud = [panels[title] for title in own if title not in silent]
            if not loud:
                edges = np.array([0.0, 1.0])
            else:
                edges = colour_edges(float(np.nanmax(loud)), float(np.nanmin(loud)))
            for axes, title in zip(axes_row, own, strict=False):
                _map_panel(axes, panels[title], plane, edges, title, title in silent)
            for axes in axes_row[len(own) :]:
                axes.set_axis_off()
            if loud:
                _colour_bar(figure, list(axes_row), edges)
            axes_row[0].set_ylabel(plane.vertical_label)
        for axes in grid[-1]:
            axes.set_xlabel(plane.horizontal_label)

    return render(WIDE_INCH, height, paint)


def colour_edges(highest_db: float, lowest_db: float) -> Real:
    """Edges of bands of 1 or 2 dB, whole multiples, from the loudest down to at most DEPTH_DB."""
    lowest_db = max(lowest_db, highest_db - DEPTH_DB)
    step = 1.0 if highest_db - lowest_db <= DEPTH_DB / 2.0 else 2.0
    low, high = np.floor(lowest_db / step), np.ceil(highest_db / step)
    return np.asarray(step * np.arange(low, max(high, low + 1) + 1))


def _map_panel(
    axes: Axes, level: Real, plane: Plane, edges: Real, title: str, silent: bool
) -> None:
    axes.set_title(plain(title), loc="left")
    axes.set_aspect("equal")
    axes.set_facecolor("#e6e6e6")  # what is left blank
    axes.grid(False)
    axes.set_xlim(plane.horizontal.min(), plane.horizontal.max())
    axes.set_ylim(plane.vertical.min(), plane.vertical.max())
    if silent:
        _write_silent(axes)
        return
    shown = np.maximum(level, edges[0])  # NaN stays and is left blank
    where = (plane.horizontal, plane.vertical)
    axes.contourf(*where, shown, levels=edges, cmap=COLOUR_MAP, extend="neither")
    lines = axes.contour(*where, shown, levels=_contours(edges), colors="white", linewidths=0.7)
    axes.clabel(lines, fmt="%.0f", fontsize=7.5)
    blank = np.isnan(level).astype(float)
    if blank.any():
        axes.contour(*where, blank, levels=[0.02], colors="black", linewidths=0.9)


def _contours(edges: Real) -> Real:
    """Round levels inside the scale: few enough to be labelled."""
    span = edges[-1] - edges[0]
    step = next((step for step in (10.0, 5.0, 2.0) if span >= 2.5 * step), 1.0)
    first = step * np.floor(edges[0] / step + 1.0)
    return np.asarray(np.arange(first, edges[-1] - 1e-9, step))


def _colour_bar(figure: Figure, axes: list[Any], edges: Real) -> None:
    bar = figure.colorbar(
        ScalarMappable(BoundaryNorm(edges, 256), COLOUR_MAP), ax=axes, pad=0.02, aspect=18
    )
    bar.ax.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    bar.set_label("dB re 20 µPa")


def _plane(radiated: xr.Dataset) -> Plane:
    """The two axes along which a map extends; the third is constant."""
    places = {name: radiated[f"map_{name}"].values for name in "xyz"}
    normal = min(places, key=lambda name: float(np.ptp(places[name])))
    across, up = [name for name in "xyz" if name != normal]
    return Plane(places[across], places[up], f"{across}, m", f"{up}, m")


# --- directivity ---------------------------------------------------------------------------------


def directivity_figure(radiated: xr.Dataset) -> Picture:
    """Balloon and two cuts of each degree of freedom that radiates, at the highest frequency."""
    field = radiated["directivity_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "polar_angle", "azimuth")
    dofs, frequency = _names(field, "dof"), float(field["line_frequency"])
    silent = _silent_dofs(field.values, dofs)
    balloons = {
        _title(dof): unit_level_db(field.values[index])
        for index, dof in enumerate(dofs)
        if dof not in silent
    }
    left_out = f" Silent and left out: {', '.join(silent)}." if silent else ""
    return Picture(
        "directivity",
        f"Directivity at {frequency:.1f} Hz: a balloon and two cuts for every degree of freedom "
        "that radiates.",
        f"Level around the machine at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns "
        "at 1 mrad/s (root mean square) in one degree of freedom. Balloon: the radius falls to "
        f"zero {DEPTH_DB:g} dB below the loudest.{left_out}",
        directivity_balloons(
            balloons, field["polar_angle"].values, field["azimuth"].values, frequency
        ),
    )


def directivity_balloons(
    levels: dict[str, Real], polar_angle: Real, azimuth: Real, frequency_hz: float
) -> bytes:
    """PNG with a row per title: balloon, vertical cuts, horizontal cut.

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


def _balloon(figure: Figure, axes: Any, level: Real, polar_angle: Real, azimuth: Real) -> None:
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


def _vertical_cuts(axes: Any, level: Real, polar_angle: Real, azimuth: Real, top: float) -> None:
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


def _horizontal_cut(axes: Any, level: Real, polar_angle: Real, azimuth: Real, top: float) -> None:
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


def _column(azimuth: Real, wanted: float) -> int:
    return int(np.argmin(np.abs(np.exp(1j * azimuth) - np.exp(1j * wanted))))


# --- table ---------------------------------------------------------------------------------------

TABLE_FREQUENCIES_HZ: Final = (50.0, 100.0, 250.0, 500.0, 1000.0, 2000.0)


def radiation_text(radiated: xr.Dataset) -> str:
    """Plain-text tables for the terminal: levels at unit velocity, their error, sound power."""
    frequency = radiated["frequency"].values
    wanted = [hertz for hertz in TABLE_FREQUENCIES_HZ if frequency[0] <= hertz <= frequency[-1]]
    nearest = sorted({int(np.argmin(np.abs(frequency - hertz))) for hertz in wanted}) or [0]
    head = tuple(f"{frequency[index]:g} Hz" for index in nearest)
    tables = [_level_table(radiated, nearest, head)]
    if "unit_sound_power_level" in radiated:
        tables.append(_power_table(radiated["unit_sound_power_level"], nearest, head))
    return "\n".join(to_text(table) for table in tables)


def _level_table(radiated: xr.Dataset, nearest: list[int], head: tuple[str, ...]) -> Table:
    field = radiated["transfer_vector"].transpose("receiver", "dof", "frequency")
    level = unit_level_db(field.values)
    error = radiated.get("transfer_vector_error")
    worst = None if error is None else _error_db(field, error)
    rows = []
    for i, receiver in enumerate(_names(field, "receiver")):
        for j, dof in enumerate(_names(field, "dof")):
            cells = [rounding.level(float(level[i, j, k])) for k in nearest]
            if worst is not None:
                cells.append(rounding.fixed(float(worst[i, j]), 2))
            rows.append((receiver, dof, *cells))
    last = () if worst is None else ("error dB",)
    caption = "Level at 1 mm/s (t), 1 mrad/s (r) rms, dB re 20 µPa; error: median estimate"
    return Table(caption, ("Microphone", "dof", *head, *last), tuple(rows), frozenset({0, 1}))


def _error_db(field: xr.DataArray, error: xr.DataArray) -> Real:
    """Median over the frequencies of 20 lg(1 + error/|T|), (receiver, dof); NaN where silent."""
    size = np.abs(field.values)
    ordered = error.transpose(*field.dims).values
    with np.errstate(divide="ignore", invalid="ignore"):
        in_db = 20.0 * np.log10(1.0 + ordered / size)
    silent = size.max(axis=-1) <= 10.0 ** (-SILENT_DB / 20.0) * size.max()
    return np.asarray(np.where(silent, np.nan, np.median(in_db, axis=-1)))


def _power_table(power: xr.DataArray, nearest: list[int], head: tuple[str, ...]) -> Table:
    ordered = power.transpose("dof", "frequency")
    rows = tuple(
        (dof, *(rounding.level(float(values[k])) for k in nearest))
        for dof, values in zip(_names(ordered, "dof"), ordered.values, strict=True)
    )
    caption = "Sound power level at 1 mm/s (t), 1 mrad/s (r) rms, dB re 1 pW"
    return Table(caption, ("dof", *head), rows)


# --- shared --------------------------------------------------------------------------------------


def _title(dof: str) -> str:
    words = DOF_WORDS.get(dof)
    return f"{dof}: {words}, {unit_words(dof)}" if words else f"{dof}, {unit_words(dof)}"


def _names(field: xr.DataArray, dim: str) -> list[str]:
    return [str(name) for name in field[dim].values]


def _rows(items: Sequence[object], columns: int) -> int:
    return max(1, -(-len(items) // columns))


def _silent_dofs(field: Complex, dofs: Sequence[str]) -> list[str]:
    """Those far below the loudest of the same unit; field (dof, ...)."""
    size = np.nanmax(np.abs(field).reshape(len(dofs), -1), axis=1)
    silent = []
    for unit in sorted({unit_words(dof) for dof in dofs}):
        same = [index for index, dof in enumerate(dofs) if unit_words(dof) == unit]
        floor = 10.0 ** (-SILENT_DB / 20.0) * size[same].max()
        silent += [dofs[index] for index in same if size[index] <= floor]
    return [dof for dof in dofs if dof in silent]


def _write_silent(axes: Axes) -> None:
    axes.text(0.5, 0.5, "no sound here", transform=axes.transAxes, ha="center", va="center")
