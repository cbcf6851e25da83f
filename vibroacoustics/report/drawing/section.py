"""Section of the machine: its parts, and the forces of the sources where they act."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.ellipse import semi_major_axis
from ...base.rounding import FORCE_FLOOR
from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import parameters
from ..charts.picture import Picture
from ..quantities import FORCE
from . import svg
from .outline import Outline, outline
from .view import View, axes_cross, bar, fitted

_WIDTH: Final = 442.0
_VIEW: Final = 300.0
_LONGEST: Final = 56.0
_PART: Final = "#c9d1d9"
_COLOUR: Final = "#b34700"
_SIZES: Final = ("height_m", "radius_m", "thickness_m")


def section_picture(results: xr.Dataset) -> Picture | None:
    """Draw parts and forces at 1× and at the loudest line; None where nothing is in the shell."""
    machine = parameters(results)["machine"]
    if "section_force" not in results or results.sizes["load_port"] < 2 or not machine.get("shell"):
        return None
    case = results.sel(shown_option=REFERENCE_OPTION)
    lines = outline(machine["shell"], {})
    parts = _parts(machine)
    views: list[str] = []
    for number, line in enumerate(case["section_line"].values):
        force = case["section_force"].sel(section_line=line).transpose("load_port", "axis")
        title = "order 1" if number == 0 else str(case["deflection_line"].item())
        views += _view(lines, parts, force, title, 8.0 + _VIEW * number)
    return Picture(
        "section",
        "Section of the machine with the forces of its sources at order 1 and at the loudest line.",
        f"Section across y at {float(results['shown_speed']):g} rpm, option {REFERENCE_OPTION}, of "
        "the representative sample: force of all sources on each part, semi-major axis, peak; a "
        "loop is its path over a period. Above order 1, below the line with the highest A-weighted "
        "level. Parts are cylinders at their nominal heights.",
        svg.drawing(_WIDTH, 8.0 + 2 * _VIEW, views, "Section of the machine with forces"),
        "svg",
    )


def _parts(machine: Mapping[str, Any]) -> list[Array]:
    """Outlines of the parts in the shell, across y, m."""
    tables = [part for part in (machine.get("frame") or {}).values() if isinstance(part, dict)]
    cylinders = [[part[size] for size in _SIZES] for part in tables if {*_SIZES} <= part.keys()]
    return [
        np.array([(x, z) for x, z in ((-r, low), (r, low), (r, high), (-r, high))])
        for middle, r, thick in cylinders
        for low, high in [(middle - 0.5 * thick, middle + 0.5 * thick)]
    ]


def _view(
    lines: Outline, parts: list[Array], force: xr.DataArray, title: str, top: float
) -> list[str]:
    """Shell, parts, forces with their names and a scale."""
    view = fitted((0, 2), lines.side, (30.0, top + 20.0), (150.0, _VIEW - 60.0))
    size = semi_major_axis(force.values, -1)
    scale = _LONGEST / max(float(size.max()), 1e-12)
    marks = [
        svg.path(view.at(lines.side), True, fill="#f4f6f8", stroke=svg.INK, stroke_width=1.2),
        *(svg.path(view.at(part), True, fill=_PART, stroke=svg.SOFT) for part in parts),
        svg.words((8.0, top + 10.0), title),
        axes_cross((16.0, top + 60.0), "x", "z"),
        bar((20.0, top + _VIEW - 14.0), scale, "N", 90.0, _COLOUR),
    ]
    heights = force["load_port_height"].values
    named = zip(force["load_port"].values, heights, force.values, size, strict=True)
    shown = [row for row in named if row[3] >= FORCE_FLOOR]
    for name, height, peak, amplitude, level in _labelled(shown, view, top):
        marks += view.vector(peak, np.array([0.0, 0.0, height]), scale, _COLOUR)
        end = view.of(np.array([0.0, 0.0, height]))
        ends = np.array([end, (250.0, level - 4.0)])
        marks.append(svg.path(ends, stroke=svg.SOFT, stroke_width=0.6, stroke_dasharray="2 2"))
        marks.append(svg.disc(end, 2.5, fill=svg.INK))
        words = f"{str(name).replace('_', ' ')}: {FORCE.write(float(amplitude))}"
        marks.append(svg.words((255.0, level), words))
    return marks


def _labelled(
    rows: list[tuple[Any, float, ComplexArray, float]], view: View, top: float
) -> list[tuple[Any, float, ComplexArray, float, float]]:
    """Rows from the top down, each with the height of its label in the drawing."""
    labelled, lowest = [], top
    for name, height, peak, amplitude in sorted(rows, key=lambda row: -row[1]):
        level = max(float(view.of(np.array([0.0, 0.0, height]))[1]) + 4.0, lowest + 18.0)
        labelled.append((name, height, peak, amplitude, level))
        lowest = level
    return labelled
