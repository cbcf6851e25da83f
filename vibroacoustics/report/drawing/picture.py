"""Drawings to scale: machine with forces and microphones, and its section with forces on parts."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.ellipse import semi_major_axis
from ...base.rounding import FORCE_FLOOR
from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import parameters
from ..charts.svg import Picture
from ..quantities import FOOT_FORCE, FORCE, MOMENT
from . import svg
from .machine import (
    Loads,
    Outline,
    View,
    axes_cross,
    bar,
    feet_m,
    fitted,
    loads,
    outline,
    rectangle,
)

WIDTH: Final = 360.0
HEIGHT: Final = 400.0
FORCE_COLOUR: Final = "#b34700"
FOOT_COLOUR: Final = "#0072b2"
ROOM_COLOUR: Final = "#00785a"
FILL: Final = "#e7ebef"
LONGEST_FORCE: Final = 62.0
LONGEST_FOOT_FORCE: Final = 26.0


def machine_picture(results: xr.Dataset) -> Picture | None:
    """Machine, feet, forces at 1× without a balancer, and microphones; None in older files."""
    machine, acting = parameters(results)["machine"], loads(results)
    if acting is None or not machine.get("shell"):
        return None
    body = parameters(results)["radiation"].get("body") or {}
    lines = outline(machine["shell"], body)
    feet = feet_m(machine)
    if len(feet) != len(acting.foot_force_n):
        return None
    receivers = _receivers_m(results, lines.floor_z_m)
    parts = [*_side(lines, feet, acting), *_above(lines, feet, receivers, _walls_m(results))]
    return Picture(
        "machine",
        "The machine from the side with its feet and the forces at 1×, and from above with the "
        "microphones, both to scale; sizes are in the caption.",
        _caption(results, acting, body),
        svg.drawing(WIDTH, HEIGHT, parts, "Machine, feet, forces and microphones"),
        "svg",
    )


def _side(lines: Outline, feet: Array, acting: Loads) -> list[str]:
    """View along y: outline, feet, floor, force at the centre of mass, forces into the feet."""
    floor = np.array([(0.0, lines.floor_z_m)])
    around = np.concatenate([lines.side, feet[:, [0, 2]], floor])
    view = fitted((0, 2), around, (110, 14), (140, 150))
    level = view.in_drawing(floor)[0, 1]
    largest_foot = max(float(np.abs(acting.foot_force_n).max()), 1e-12)
    largest = max(acting.force_amplitude_n, 1e-12)
    foot_scale, scale = LONGEST_FOOT_FORCE / largest_foot, LONGEST_FORCE / largest
    ground = np.array([(20.0, level), (340.0, level)])
    parts = [
        svg.path(view.in_drawing(lines.side), True, fill=FILL, stroke=svg.INK, stroke_width=1.2),
        svg.path(ground, stroke=svg.SOFT, stroke_dasharray="5 3"),
        *(_mount(view, foot, level) for foot in feet),
    ]
    for foot, peak in zip(feet, acting.foot_force_n, strict=True):
        parts += view.vector(peak, foot, foot_scale, FOOT_COLOUR)
    parts += view.vector(acting.force_n, np.zeros(3), scale, FORCE_COLOUR)
    parts.append(svg.disc(view.origin, 3, fill=svg.INK))
    return [
        *parts,
        axes_cross((20, 60), "x", "z"),
        svg.words((340, 24), "from the side", "end", fill=svg.SOFT),
        bar((20, 192), view.scale, "m", 50.0),
        bar((132, 192), scale, "N", 50.0, FORCE_COLOUR),
        bar((236, 192), foot_scale, "N foot", 40.0, FOOT_COLOUR),
    ]


def _mount(view: View, foot: Array, level: float) -> str:
    x, y = view.of(foot)
    low = max(level, y + 3.0)
    sides = np.array([(x - 4, y), (x + 4, y), (x + 6, low), (x - 6, low)])
    return svg.path(sides, True, fill="#fff", stroke=svg.INK)


def _above(
    lines: Outline, feet: Array, receivers: dict[str, Array], walls: list[tuple[int, float]]
) -> list[str]:
    """View along z: outline, feet, walls, numbered microphones."""
    points = [point[:2] for point in receivers.values()]
    points += [np.where(np.arange(2) == axis, coordinate, 0.0) for axis, coordinate in walls]
    around = np.concatenate([lines.above, np.array(points).reshape(-1, 2)])
    view = fitted((0, 1), around, (40, 220), (280, 140))
    parts = [_wall(view, axis, coordinate) for axis, coordinate in walls]
    parts.append(svg.path(view.in_drawing(lines.above), True, fill=FILL, stroke=svg.INK))
    parts += [svg.disc(view.of(foot), 1.5, fill=svg.INK) for foot in feet]
    for number, point in enumerate(receivers.values(), 1):
        x, y = view.of(point)
        parts.append(svg.disc((x, y), 8, fill=ROOM_COLOUR))
        looks = {"fill": "#fff", "stroke": "none", "font_size": 11}
        parts.append(svg.words((x, y + 4), str(number), "middle", **looks))
    return [
        *parts,
        axes_cross((20, 256), "x", "y"),
        svg.words((340, 218), "from above", "end", fill=svg.SOFT),
        bar((20, 392), view.scale, "m", 90.0),
    ]


def _wall(view: View, axis: int, at_m: float) -> str:
    x, y = view.in_drawing(np.full(2, at_m))
    ends = [(x, 214.0), (x, 374.0)] if axis == 0 else [(14.0, y), (346.0, y)]
    return svg.path(np.array(ends), stroke=svg.SOFT, stroke_width=3)


def _receivers_m(results: xr.Dataset, floor_z_m: float) -> dict[str, Array]:
    stand = parameters(results)["receivers"]
    return {
        name: np.array(
            [stand[name]["x_m"], stand[name]["y_m"], floor_z_m + stand[name]["height_m"]]
        )
        for name in map(str, results["receiver"].values)
    }


def _walls_m(results: xr.Dataset) -> list[tuple[int, float]]:
    """Number of the axis across each wall, and its coordinate."""
    surroundings = parameters(results)["radiation"].get("surroundings")
    walls = surroundings.get("walls", {}) if isinstance(surroundings, dict) else {}
    return [
        ("xy".index(side[1]), (-1.0 if side[0] == "-" else 1.0) * wall["distance_m"])
        for side, wall in walls.items()
    ]


def _caption(results: xr.Dataset, acting: Loads, body: dict[str, Any]) -> str:
    stand = parameters(results)["receivers"]
    heights = [
        f"{number} {name}, {rounding.fixed(stand[str(name)]['height_m'], 2)} m high"
        for number, name in enumerate(results["receiver"].values, 1)
    ]
    foot = float(semi_major_axis(acting.foot_force_n, -1).max())
    mesh = " The mesh that radiates is drawn as the shell." if body.get("kind") == "mesh" else ""
    return (
        f"At 1× and {acting.speed_rpm:g} rpm without a balancer: force "
        f"{FORCE.write(acting.force_amplitude_n)} and moment "
        f"{MOMENT.write(acting.moment_amplitude_nm)} about the centre of mass (dot). Largest force "
        f"into a foot: {FOOT_FORCE.write(foot)}. Arrows are peaks, loops their paths over a "
        f"revolution. Microphones: {'; '.join(heights)}.{mesh}"
    )


_WIDTH: Final = 442.0
_VIEW: Final = 300.0
_LONGEST: Final = 56.0
_PART: Final = "#c9d1d9"
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
        "one weighted sample: force of all sources on each part, semi-major axis, peak. "
        "Loops: path of the force vector over a period. Above order 1, below the line with the "
        "highest A-weighted level. Parts are cylinders at their nominal heights.",
        svg.drawing(_WIDTH, 8.0 + 2 * _VIEW, views, "Section of the machine with forces"),
        "svg",
    )


def _parts(machine: Mapping[str, Any]) -> list[Array]:
    """Outlines of the parts in the shell, across y, m."""
    tables = [part for part in (machine.get("frame") or {}).values() if isinstance(part, dict)]
    cylinders = [[part[size] for size in _SIZES] for part in tables if {*_SIZES} <= part.keys()]
    return [
        rectangle(r, middle - 0.5 * thick, middle + 0.5 * thick) for middle, r, thick in cylinders
    ]


def _view(
    lines: Outline, parts: list[Array], force: xr.DataArray, title: str, top: float
) -> list[str]:
    """Shell, parts, forces with their names and a scale."""
    view = fitted((0, 2), lines.side, (30.0, top + 20.0), (150.0, _VIEW - 60.0))
    size = semi_major_axis(force.values, -1)
    scale = _LONGEST / max(float(size.max()), 1e-12)
    marks = [
        svg.path(
            view.in_drawing(lines.side), True, fill="#f4f6f8", stroke=svg.INK, stroke_width=1.2
        ),
        *(svg.path(view.in_drawing(part), True, fill=_PART, stroke=svg.SOFT) for part in parts),
        svg.words((8.0, top + 10.0), title),
        axes_cross((16.0, top + 60.0), "x", "z"),
        bar((20.0, top + _VIEW - 14.0), scale, "N", 90.0, FORCE_COLOUR),
    ]
    heights = force["load_port_height"].values
    named = zip(force["load_port"].values, heights, force.values, size, strict=True)
    lowest = top
    for name, height, peak, amplitude in sorted(named, key=lambda row: -row[1]):
        if not amplitude >= FORCE_FLOOR:
            continue
        point = np.array([0.0, 0.0, height])
        end = view.of(point)
        lowest = max(float(end[1]) + 4.0, lowest + 18.0)
        marks += view.vector(peak, point, scale, FORCE_COLOUR)
        ends = np.array([end, (250.0, lowest - 4.0)])
        marks.append(svg.path(ends, stroke=svg.SOFT, stroke_width=0.6, stroke_dasharray="2 2"))
        marks.append(svg.disc(end, 2.5, fill=svg.INK))
        words = f"{str(name).replace('_', ' ')}: {FORCE.write(float(amplitude))}"
        marks.append(svg.words((255.0, lowest), words))
    return marks
