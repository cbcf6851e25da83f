"""Axes of a panel: where the values of its marks are."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...base.arrays import Array
from .colours import numbers
from .layout import Box, Scale, scale_of
from .marks import Bars, Image, Line, Mark, Note, Panel, Points, Segments, Span


class Frame(NamedTuple):
    """The axes of a panel: where its values are.

    Attributes
    ----------
    box : of the axes
    x, y : scales; of a polar panel angle in degrees and radius
    polar : angles run from the right, counter-clockwise
    """

    box: Box
    x: Scale
    y: Scale
    polar: bool

    def points(self, x: Any, y: Any) -> Array:
        """Return positions of values, shape (n, 2)."""
        if not self.polar:
            across, up = self.x.share(x), self.y.share(y)
            across = self.box.x + self.box.width * across
            down = self.box.y + self.box.height * (1.0 - up)
            return np.stack(np.broadcast_arrays(across, down), axis=-1)
        angle = np.radians(numbers(x))
        radius = np.clip(self.y.share(y), 0.0, None) * self.radius
        middle = self.middle
        return np.stack(
            [middle[0] + radius * np.cos(angle), middle[1] - radius * np.sin(angle)], axis=-1
        )

    def ends(self, mark: Segments) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Return starts and ends of segments; an end of the axis where a value is not finite."""
        ends = ((mark.x, self.x), (mark.y, self.y), (mark.x_end, self.x), (mark.y_end, self.y))
        sides = ("low", "low", "high", "high")
        x, y, x_end, y_end = np.broadcast_arrays(
            *(
                np.atleast_1d(np.where(np.isfinite(values), values, getattr(scale, side)))
                for (values, scale), side in zip(
                    ((numbers(values), scale) for values, scale in ends), sides, strict=True
                )
            )
        )
        return (x, y), (x_end, y_end)

    @property
    def radius(self) -> float:
        """Half of the smaller side of the axes."""
        return 0.5 * min(self.box.width, self.box.height)

    @property
    def middle(self) -> tuple[float, float]:
        """Middle of the axes."""
        return self.box.x + 0.5 * self.box.width, self.box.y + 0.5 * self.box.height


def frame_of(panel: Panel, box: Box) -> Frame | None:
    """Return the axes of a panel; None where it has nothing to show.

    Parameters
    ----------
    panel : with its marks
    box : that the axes fill, unless both have one scale
    """
    is_image = any(isinstance(mark, Image) for mark in panel.marks)
    x, y = (
        scale_of(axis, _extents(panel.marks, letter), is_image)
        for letter, axis in (("x", panel.x), ("y", panel.y))
    )
    if panel.polar:
        x = Scale(0.0, 360.0, panel.x.ticks or _ANGLES, False)
    if x is None or y is None or not panel.marks:
        return None
    return Frame(_squared(box, x, y) if panel.equal else box, x, y, panel.polar)


_ANGLES = tuple((45.0 * number, f"{45 * number}°") for number in range(8))


def _extents(marks: Sequence[Mark], letter: str) -> Array:
    return np.concatenate([np.empty(0), *(_extent(mark, letter) for mark in marks)])


def _extent(mark: Mark, letter: str) -> Array:
    """Return the values of a mark along an axis, shape (n,)."""
    if isinstance(mark, Span | Note):
        return np.empty(0)
    if isinstance(mark, Bars):
        position, size, base = np.broadcast_arrays(
            *map(numbers, (mark.position, mark.size, mark.base))
        )
        if (letter == "x") == mark.upright:
            half = 0.5 * mark.thickness
            return numbers(np.concatenate([position - half, position + half]))
        ends = [] if mark.interval is None else [numbers(end) for end in mark.interval]
        return numbers(np.concatenate([base, base + size, *ends]))
    if isinstance(mark, Image):
        return edges_of(numbers(getattr(mark, letter)))
    if isinstance(mark, Segments):
        ends_of = (getattr(mark, letter), getattr(mark, f"{letter}_end"))
        return numbers(np.concatenate([numbers(end).ravel() for end in ends_of]))
    values = [numbers(getattr(mark, letter)).ravel()]
    if letter == "y" and isinstance(mark, Line | Points) and mark.interval is not None:
        values += [numbers(end).ravel() for end in mark.interval]
    return np.concatenate(values)


def edges_of(middles: Array) -> Array:
    """Return the first and last edge of cells about their middles."""
    if middles.size < 2:
        return np.asarray([middles.min() - 0.5, middles.max() + 0.5])
    steps = np.diff(middles)
    return np.asarray([middles[0] - 0.5 * steps[0], middles[-1] + 0.5 * steps[-1]])


def _squared(box: Box, x: Scale, y: Scale) -> Box:
    """The largest part of a box in which both axes have one scale."""
    scale = min(box.width / abs(x.high - x.low), box.height / abs(y.high - y.low))
    width, height = scale * abs(x.high - x.low), scale * abs(y.high - y.low)
    return Box(box.x, box.y + 0.5 * (box.height - height), width, height)
