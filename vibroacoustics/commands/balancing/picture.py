"""Picture of a plane: rotation, mark, zero, holes and weights, in the angles of the file."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from ...design.bench.balanced_runs import BalancedRuns, PlacedWeight
from ...measured.trial_runs.settings import Plane, hole_angles_rad
from ...report.charts.svg import Picture
from ...report.drawing import svg

WIDTH: Final = 400.0
HEIGHT: Final = 392.0
_CENTRE: Final = np.array([200.0, 215.0])
_RADIUS: Final = 95.0
_MOST_NUMBERED: Final = 24
_WEIGHT: Final = "#c0392b"
_TURN: Final = "#1a5fb4"
_SCALE: Final = "#2d7d46"


def plane_picture(result: BalancedRuns, name: str) -> Picture:
    """Draw a plane with the weights to add.

    Parameters
    ----------
    result : answer for runs
    name : name of the plane
    """
    plane = result.settings.planes[name]
    weights = [weight for weight in result.weights if weight.plane == name]
    parts = [
        svg.words((8, 18), f"Plane {name}: angles count {result.settings.angles}"),
        svg.disc(_CENTRE, _RADIUS, fill="#f3f5f7", stroke=svg.INK, stroke_width=1.5),
        svg.disc(_CENTRE, 4, fill=svg.INK),
        *_mark(),
        *_rotation(result),
        *_zero(result, plane),
        *_holes(result, plane),
        *(part for weight in weights for part in _weight(result, plane, weight)),
    ]
    content = svg.drawing(WIDTH, HEIGHT, parts, f"Plane {name} with the weights to add")
    words = "; ".join(weight_words(weight) for weight in weights) or "no weight"
    return Picture(
        f"plane_{name}",
        f"Plane {name}: {words}",
        f"Plane {name} from the side that angles are read from, its mark at the tacho. "
        f"Add {words}.",
        content,
        "svg",
    )


def weight_words(weight: PlacedWeight) -> str:
    """Mass and position in words: `8.4 g in hole 3 (60°)`.

    Parameters
    ----------
    weight : weight to add
    """
    angle = f"{np.rad2deg(weight.angle_rad):.0f}°"
    where = f"in hole {weight.hole} ({angle})" if weight.hole else f"at {angle}"
    return f"{1e3 * weight.mass_kg:.3g} g {where}"


def _at(result: BalancedRuns, plane: Plane, angle_rad: float, radius: float) -> Array:
    """Point at an angle of the file from the zero of a plane; the mark is at the top."""
    with_rotation = result.settings.sense * (plane.zero_rad + angle_rad)
    turn = 1.0 if result.settings.rotation == "counterclockwise" else -1.0
    angle = 0.5 * np.pi + turn * with_rotation
    return np.asarray(_CENTRE + radius * np.array([np.cos(angle), -np.sin(angle)]))


def _mark() -> list[str]:
    top = _CENTRE - np.array([0.0, _RADIUS])
    foot = top + np.array([[-6.0, 0.0], [6.0, 0.0], [0.0, 14.0]])
    sensor = top + np.array([[-7.0, -26.0], [7.0, -26.0], [7.0, -10.0], [-7.0, -10.0]])
    return [
        svg.path(foot, True, fill=svg.INK),
        svg.path(sensor, True, fill="#fff", stroke=svg.INK),
        svg.words(top - np.array([12.0, 20.0]), "tacho at mark", "end", fill=svg.SOFT),
    ]


def _arc(start: float, end: float, radius: float) -> Array:
    angle = np.linspace(start, end, 30)
    return np.asarray(_CENTRE + radius * np.column_stack([np.cos(angle), -np.sin(angle)]))


def _rotation(result: BalancedRuns) -> list[str]:
    """Arrow of the rotation, within the disc."""
    turn = 1.0 if result.settings.rotation == "counterclockwise" else -1.0
    arc = _arc(-0.5 * np.pi - 0.6 * turn, -0.5 * np.pi + 0.6 * turn, 48.0)
    return [
        svg.path(arc, fill="none", stroke=_TURN, stroke_width=2),
        svg.arrow(arc[-4], arc[-1] + (arc[-1] - arc[-4]), _TURN),
        svg.words(_CENTRE + np.array([0.0, 26.0]), "rotation", "middle", fill=_TURN),
    ]


def _zero(result: BalancedRuns, plane: Plane) -> list[str]:
    """Zero of the plane, and the direction in which its angles count."""
    angles = np.deg2rad(np.arange(0.0, 61.0, 2.0))
    arc = np.array([_at(result, plane, float(angle), _RADIUS + 66.0) for angle in angles])
    outer = _at(result, plane, 0.0, _RADIUS + 72.0)
    return [
        svg.path(np.array([_at(result, plane, 0.0, _RADIUS + 30.0), outer]), stroke=_SCALE,
                 stroke_width=2),
        svg.path(arc, fill="none", stroke=_SCALE, stroke_width=1.5),
        svg.arrow(arc[-4], arc[-1] + (arc[-1] - arc[-4]), _SCALE),
        svg.words(_at(result, plane, 0.13, _RADIUS + 80.0).tolist(), "0°", "middle", fill=_SCALE),
        svg.words(_at(result, plane, 1.25, _RADIUS + 68.0).tolist(), "60°", "middle", fill=_SCALE),
    ]  # fmt: skip


def _holes(result: BalancedRuns, plane: Plane) -> list[str]:
    parts = []
    angles = hole_angles_rad(plane)
    for number, angle in enumerate(angles, start=1):
        parts.append(svg.disc(_at(result, plane, angle, 78.0), 4, fill="#fff", stroke=svg.INK))
        if len(angles) <= _MOST_NUMBERED:
            where = _at(result, plane, angle, 64.0) + np.array([0.0, 4.0])
            parts.append(svg.words(where, str(number), "middle", font_size=10, fill=svg.SOFT))
    return parts


def _weight(result: BalancedRuns, plane: Plane, weight: PlacedWeight) -> list[str]:
    where = _at(result, plane, weight.angle_rad, 78.0)
    outside = _at(result, plane, weight.angle_rad, _RADIUS + 14.0)
    anchor = "start" if outside[0] >= _CENTRE[0] else "end"
    label = f"{1e3 * weight.mass_kg:.3g} g"
    return [
        svg.disc(where, 8, fill=_WEIGHT),
        svg.words(outside + np.array([0.0, 4.0]), label, anchor, fill=_WEIGHT, font_weight="bold"),
    ]
