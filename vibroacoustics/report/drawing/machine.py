"""Views of a machine: outline about its centre of mass, and its forces at 1× without a balancer."""

from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.revolution import shell_profile, sphere
from ...base.vocabulary import REFERENCE_OPTION
from . import svg

_ANGLE: Final = 2.0 * np.pi * np.arange(48) / 48
_CIRCLE: Final = np.column_stack([np.cos(_ANGLE), np.sin(_ANGLE)])


class Outline(NamedTuple):
    """Closed lines, m.

    Attributes
    ----------
    side : x and z, shape (point, 2)
    above : x and y, shape (point, 2)
    floor_z_m : height of the floor from the centre of mass
    """

    side: Array
    above: Array
    floor_z_m: float


def outline(shell: Mapping[str, Any], body: Mapping[str, Any]) -> Outline:
    """Outline of the shell, or of the block or sphere that radiates in its stead.

    A mesh is drawn as the shell: the results do not hold its triangles.
    """
    bottom = -shell["centre_of_mass_height_m"]
    floor = bottom - shell["floor_clearance_m"]
    kind = body.get("kind", "shell")
    if kind == "box":
        half_x, half_y = body["length_m"] / 2.0, body["width_m"] / 2.0
        side = rectangle(half_x, bottom, bottom + body["height_m"])
        return Outline(side, rectangle(half_x, -half_y, half_y), floor)
    radius = body["diameter_m"] / 2.0 if kind == "sphere" else 0.0
    profile = sphere(radius, bottom + radius) if radius else shell_profile(shell)
    right = profile.points()
    side = np.concatenate([right, right[::-1] * [-1.0, 1.0]])
    return Outline(side, profile.radius_m * _CIRCLE, floor)


def feet_m(machine: Mapping[str, Any]) -> Array:
    """Feet (x, y, z) from the centre of mass, shape (foot, 3); four in a square if not given.

    None in files of older versions, which hold no mounts.
    """
    under = -machine["shell"]["centre_of_mass_height_m"]
    feet = machine.get("feet")
    if feet:
        given_feet = [foot for _, foot in sorted(feet.items()) if foot is not None]
        heights = [
            under if foot.get("height_m") is None else foot["height_m"] for foot in given_feet
        ]
        return np.array([(f["x_m"], f["y_m"], z) for f, z in zip(given_feet, heights, strict=True)])
    if not machine.get("mounts"):
        return np.empty((0, 3))
    half = machine["mounts"]["pitch_m"] / 2.0
    return np.array([(x, y, under) for x in (half, -half) for y in (half, -half)])


def rectangle(half: float, lower: float, upper: float) -> Array:
    """Corners of a rectangle about the vertical axis, shape (4, 2)."""
    return np.array([(-half, lower), (half, lower), (half, upper), (-half, upper)])


NEEDED = ("force_order", "moment_order", "foot_force_order", "force_amplitude", "moment_amplitude")


class Loads(NamedTuple):
    """Complex peaks at 1×, at the speed at which the resultant force is largest.

    Force and moment on the machine about its centre of mass, shape (axis,), with the semi-major
    axes of their ellipses, and forces into the feet, shape (foot, axis).
    """

    speed_rpm: float
    force_n: ComplexArray
    moment_nm: ComplexArray
    foot_force_n: ComplexArray
    force_amplitude_n: float
    moment_amplitude_nm: float


def loads(results: xr.Dataset) -> Loads | None:
    """Nominal loads without a balancer; None in files of older versions."""
    if any(name not in results for name in NEEDED):
        return None
    first = results[list(NEEDED)].sel(option=REFERENCE_OPTION, order=1)
    loudest = first.isel(speed=int(first["force_amplitude"].argmax("speed")))
    return Loads(
        float(loudest["speed"]),
        loudest["force_order"].sum("source").values,
        loudest["moment_order"].sum("source").values,
        loudest["foot_force_order"].sum("source").transpose("foot", "axis").values,
        float(loudest["force_amplitude"]),
        float(loudest["moment_amplitude"]),
    )


def turn(peak: ComplexArray, axes: tuple[int, int]) -> Array:
    """Ends of the vector Re{peak exp(j angle)} over a turn in the plane of axes, shape (72, 2)."""
    angle = 2.0 * np.pi * np.arange(72) / 72
    return np.asarray((np.exp(1j * angle)[:, None] * peak[list(axes)]).real)


_NICE: Final = np.outer(np.logspace(-6, 6, 13), [1, 2, 5]).ravel()
_FLAT: Final = 0.03
"""Ellipses with a smaller ratio of their axes are drawn as a line with two heads."""


class View(NamedTuple):
    """Projection on the axes that go right and up, with one scale, drawing units a metre.

    The origin is where the centre of mass is in the drawing, (x, y).
    """

    axes: tuple[int, int]
    scale: float
    origin: Array

    def in_drawing(self, points_m: Array) -> Array:
        """Points of the plane, shape (..., 2), in the drawing."""
        return np.asarray(self.origin + self.scale * points_m * [1.0, -1.0])

    def of(self, points_m: Array) -> Array:
        """Points in space, shape (..., 3), in the drawing."""
        return self.in_drawing(points_m[..., list(self.axes)])

    def vector(self, peak: ComplexArray, from_m: Array, scale: float, colour: str) -> list[str]:
        """Path of a complex peak, shape (axis,), over a revolution, with arrows to its ends.

        It acts at a point, shape (3,); the scale is drawing units per unit of the vector.
        """
        tail = self.of(from_m)
        ends = tail + scale * turn(peak, self.axes) * [1.0, -1.0]
        size = np.linalg.norm(ends - tail, axis=1)
        furthest = int(size.argmax())
        parts = [svg.arrow(tail, ends[furthest], colour)]
        if size.min() < _FLAT * size.max():
            return [*parts, svg.arrow(tail, 2.0 * tail - ends[furthest], colour)]
        return [svg.path(ends, True, fill="none", stroke=colour), *parts]


def fitted(
    axes: tuple[int, int], around_m: Array, corner: Sequence[float], size: Sequence[float]
) -> View:
    """The view that fits points of its plane, shape (point, 2), into a frame of the drawing."""
    lower, upper = around_m.min(axis=0), around_m.max(axis=0)
    room, extent = np.asarray(size, dtype=float), np.maximum(upper - lower, 1e-6)
    scale = float((room / extent).min())
    middle = np.asarray(corner) + room / 2.0
    return View(axes, scale, middle - scale * (lower + upper) / 2.0 * [1.0, -1.0])


def bar(
    position: Sequence[float], scale: float, unit: str, longest: float, colour: str = svg.INK
) -> str:
    """A scale, drawing units per unit: a bar of a round length with its value; below 1 m in mm."""
    value = float(_NICE[_NICE * scale <= longest].max(initial=_NICE[0]))
    x, y = position
    ends = np.array([(x, y - 4), (x, y), (x + value * scale, y), (x + value * scale, y - 4)])
    text = f"{1e3 * value:g} mm" if unit == "m" and value < 1.0 else f"{value:g} {unit}"
    line = svg.path(ends, fill="none", stroke=colour, stroke_width=1.5)
    return line + svg.words((x + value * scale + 5, y), text, fill=colour)


def axes_cross(position: Sequence[float], right: str, up: str) -> str:
    """Show which axes go right and up."""
    x, y = position
    corner = np.array([x, y])
    return (
        svg.arrow(corner, np.array([x + 22.0, y]), svg.SOFT)
        + svg.arrow(corner, np.array([x, y - 22.0]), svg.SOFT)
        + svg.words((x + 25, y + 4), right, fill=svg.SOFT)
        + svg.words((x - 3, y - 26), up, fill=svg.SOFT)
    )
