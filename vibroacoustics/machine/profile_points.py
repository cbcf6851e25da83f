"""Points of a profile that a file gives: why they bound no body of revolution."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.revolution import Point

FEWEST: Final = 3
MOST: Final = 200
"""Each line between points costs the radiation one element or more."""
_LEAST_LINE_M: Final = 1e-4
_TOUCHING_M: Final = 1e-5
_RADIUS_M: Final = (0.01, 1.0)
_HEIGHT_M: Final = (0.02, 3.0)


def why_no_body(points: tuple[Point, ...]) -> Iterator[str]:
    """Give what is wrong with the points of a profile, in the order in which it matters.

    Parameters
    ----------
    points : radius and height above the lowest of them, m
    """
    if not FEWEST <= len(points) <= MOST:
        yield f"{len(points)} points; allowed from {FEWEST} to {MOST}"
        return
    corners = np.array(points)
    (radius, height), leftmost = corners.T, int(np.argmin(corners[:, 0]))
    if radius[leftmost] < 0.0:
        yield (
            f"point {leftmost + 1} = {_shown(corners[leftmost])} mm: the radius must not be "
            "negative"
        )
    for end, word in ((0, "first"), (-1, "last")):
        if radius[end] != 0.0:
            yield (
                f"{word} point = {_shown(corners[end])} mm: must be on the axis, at radius 0, so "
                "that the body is closed"
            )
    if not height[0] < height[-1]:
        yield (
            f"runs from {1e3 * height[0]:g} to {1e3 * height[-1]:g} mm on the axis: must run from "
            "its bottom to its top"
        )
    if height.min() != 0.0:
        yield f"lowest height = {1e3 * height.min():g} mm: must be 0, heights count from there"
    yield from _out_of_range(radius, height)
    yield from _crossings(corners)


def _out_of_range(radius: Array, height: Array) -> Iterator[str]:
    for name, value, (least, most) in (
        ("radius", radius.max(), _RADIUS_M),
        ("height", height.max(), _HEIGHT_M),
    ):
        if not least <= value <= most:
            yield (
                f"largest {name} = {1e3 * value:g} mm: allowed from {1e3 * least:g} to "
                f"{1e3 * most:g} mm"
            )


def _crossings(corners: Array) -> Iterator[str]:
    """Give lines that are too short, meet the axis, each other, or lead back on themselves."""
    step = np.diff(corners, axis=0)
    length = np.linalg.norm(step, axis=1)
    short = int(np.argmin(length))
    if length[short] < _LEAST_LINE_M:
        yield (
            f"points {short + 1} and {short + 2}: {1e3 * length[short]:.3g} mm apart; at least "
            f"{1e3 * _LEAST_LINE_M:g} mm are needed"
        )
        return
    inner = np.flatnonzero(corners[1:-1, 0] < _TOUCHING_M)
    if inner.size:
        yield (
            f"point {inner[0] + 2} = {_shown(corners[inner[0] + 1])} mm: the profile crosses "
            "itself on the axis, where only its first and last point may be"
        )
    lines = np.argwhere(_meet(corners, step))
    if lines.size:
        first, second = lines[0] + 1
        yield (
            f"the lines after point {first} and after point {second} cross or touch: a profile "
            "must not cross itself"
        )


def _meet(corners: Array, step: Array) -> Array:
    """Whether two lines have more than their common end in common, shape (line, line)."""
    ahead = corners[None, :] - corners[:-1, None]
    share = np.sum(ahead * step[:, None], axis=2) / np.sum(step**2, axis=1)[:, None]
    nearest = np.clip(share, 0.0, 1.0)[..., None] * step[:, None]
    line, point = np.ogrid[: len(step), : len(corners)]
    touches = np.linalg.norm(ahead - nearest, axis=2) < _TOUCHING_M
    touches &= (point != line) & (point != line + 1)
    side = step[:, None, 0] * ahead[..., 1] - step[:, None, 1] * ahead[..., 0]
    parts = side[:, :-1] * side[:, 1:] < 0.0
    by_point = touches[:, :-1] | touches[:, 1:]
    beside = np.abs(np.subtract.outer(np.arange(len(step)), np.arange(len(step)))) > 1
    return np.asarray(np.triu((parts & parts.T & beside) | by_point | by_point.T))


def _shown(point: Array) -> str:
    return f"[{1e3 * point[0]:g}, {1e3 * point[1]:g}]"
