"""Axes of a panel: where the values of its marks are."""

from typing import Any, NamedTuple

import numpy as np

from ...base.arrays import Array
from .layout import Box, Scale, scale_of
from .marks import Bars, Image, Line, Mark, Note, Panel, Points, Segments, Span, numbers


class Frame(NamedTuple):
    """The axes of a panel: where its values are; of a polar one angle in degrees and radius."""

    box: Box
    x: Scale
    y: Scale
    polar: bool

    def points(self, x: Any, y: Any) -> Array:
        """Return positions of values, shape (n, 2)."""
        if self.polar:
            angle, radius = self.angle(x), np.clip(self.y.share(y), 0.0, None) * self.radius
            across = self.middle[0] + radius * np.cos(angle)
            down = self.middle[1] - radius * np.sin(angle)
        else:
            across = self.box.x + self.box.width * self.x.share(x)
            down = self.box.y + self.box.height * (1.0 - self.y.share(y))
        return np.stack(np.broadcast_arrays(across, down), axis=-1)

    def ends(self, mark: Segments) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Return starts and ends of segments; an end of the axis where a value is not finite."""
        x, y, x_end, y_end = np.broadcast_arrays(
            *(
                np.atleast_1d(np.where(np.isfinite(values), values, end))
                for values, end in (
                    (numbers(mark.x), self.x.low), (numbers(mark.y), self.y.low),
                    (numbers(mark.x_end), self.x.high), (numbers(mark.y_end), self.y.high),
                )
            )
        )  # fmt: skip
        return (x, y), (x_end, y_end)

    def angle(self, values: Any) -> Array:
        """Return values along x, those of a polar panel in radians, as matplotlib has them."""
        return np.radians(numbers(values)) if self.polar else numbers(values)

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

    They fill a box, unless both have one scale.
    """
    is_image = any(isinstance(mark, Image) for mark in panel.marks)
    x, y = (
        scale_of(axis, np.concatenate([[], *(_extent(m, letter) for m in panel.marks)]), is_image)
        for letter, axis in (("x", panel.x), ("y", panel.y))
    )
    if panel.polar:
        x = Scale(0.0, 360.0, panel.x.ticks or _ANGLES, False)
    if x is None or y is None or not panel.marks:
        return None
    return Frame(_squared(box, x, y) if panel.equal else box, x, y, panel.polar)


_ANGLES = tuple((45.0 * number, f"{45 * number}°") for number in range(8))


def _extent(mark: Mark, letter: str) -> Array:
    """Return the values of a mark along an axis, shape (n,)."""
    if isinstance(mark, Span | Note):
        return np.empty(0)
    if isinstance(mark, Bars):
        parts = map(numbers, (mark.position, mark.size, mark.base))
        position, size, base = np.broadcast_arrays(*parts)
        if (letter == "x") == mark.upright:
            half = 0.5 * mark.thickness
            return numbers(np.concatenate([position - half, position + half]))
        ends = map(numbers, mark.interval or ())
        return numbers(np.concatenate([base, base + size, *ends]))
    if isinstance(mark, Image):
        return edges_of(numbers(getattr(mark, letter)))
    values = [getattr(mark, letter)]
    if isinstance(mark, Segments):
        values.append(getattr(mark, f"{letter}_end"))
    elif letter == "y" and isinstance(mark, Line | Points):
        values += mark.interval or ()
    return np.concatenate([numbers(each).ravel() for each in values])


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
