"""A view of the drawing: from metres to the drawing's unit, and what both views show."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from . import svg
from .machine import turn

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
