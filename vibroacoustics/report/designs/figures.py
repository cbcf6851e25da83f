"""Charts of many designs: front, parallel coordinates, main effects."""

from collections.abc import Iterator, Sequence
from typing import Final, Literal

import numpy as np

from ...base.arrays import Array, IndexArray
from ..charts.layout import COLOURS, shortened, wrapped
from ..charts.marks import Axis, Chart, Line, Mark, Note, Panel, Points, named_axis
from .evaluated import Column, Evaluated

_MOST_POINTS: Final = 5_000
_MOST_LINES: Final = 200
_BINS: Final = 12
_GREY, _BLUE, _PALE = "#bbbbbb", COLOURS[3], "#8cb8d9"
_OF_BEST: Final = (COLOURS[1], COLOURS[0], COLOURS[5], COLOURS[4], COLOURS[2])
_PANELS: Final = 4
"""Variables of a chart of main effects."""


def front_chart(designs: Evaluated) -> Chart:
    """Return every objective over the first, of two or more: allowed designs, front, best few."""
    first, *others = designs.objectives
    front = np.flatnonzero(designs.front)
    x_ends = _near_front(first.values, front)
    panels = []
    for other in others:
        y_ends = _near_front(other.values, front)
        is_shown = designs.met & ~designs.front
        for column, (low, high) in ((first, x_ends), (other, y_ends)):
            is_shown = is_shown & (column.values >= low) & (column.values <= high)
        every = [
            (_thinned(np.flatnonzero(is_shown)), _GREY, 3.0, "allowed designs"),
            (front, _BLUE, 4.5, "front"),
        ]
        marks = [
            Points(first.values[rows], other.values[rows], name, None, colour, "o", size)
            for rows, colour, size, name in every
        ]
        marks += [
            Points(
                [first.values[row]], [other.values[row]], f"design {number}", None,
                _colour(number), "o", 9.0, filled=False,
            )
            for number, row in enumerate(designs.best, 1)
        ]  # fmt: skip
        x = Axis(wrapped(first.heading, 60), limits=x_ends)
        y = Axis(wrapped(shortened(other.heading, 64), 34), limits=y_ends)
        panels.append(Panel(x, y, tuple(marks), height=3.1))
    return Chart(
        "front",
        "Objectives of all allowed designs and of the front; the best few are in the table.",
        f"Front of {int(designs.front.sum())} designs of which none is better in every "
        "objective than another; the numbers are those of the table.",
        tuple(panels),
    )


def _colour(number: int) -> str:
    return _OF_BEST[(number - 1) % len(_OF_BEST)]


def _near_front(values: Array, front: IndexArray) -> tuple[float, float]:
    """Return limits of an axis that show the front and what is near it."""
    low, high = float(values[front].min()), float(values[front].max())
    span = max(high - low, 1e-3 * abs(low), 1e-12)
    more_is_better = np.median(values) < 0.5 * (low + high)
    near, far = 0.15 * span, 1.5 * span
    return (low - far, high + near) if more_is_better else (low - near, high + far)


def parallel_chart(designs: Evaluated) -> Chart:
    """Return parallel coordinates of the front: a line a design over variables and objectives.

    At most 200 of the front's designs are drawn, and the best few.
    """
    columns = (*designs.variables, *designs.objectives)
    front = _thinned(np.flatnonzero(designs.front), _MOST_LINES)
    rows = np.flatnonzero(designs.met)
    scaled = np.stack([_share(column.values, rows) for column in columns])
    height = np.arange(float(len(columns)))
    gaps = np.full((1, front.size), np.nan)  # between designs
    shares = np.concatenate([scaled[:, front], gaps]).T.ravel()
    heights = np.tile([*height, np.nan], front.size)
    best = (
        Line(scaled[:, row], height, f"design {n}", None, _colour(n), "-", "o", 1.4)
        for n, row in enumerate(designs.best, 1)
    )
    marks = (Line(shares, heights, "", None, _PALE, "-", width=0.6), *best, *_ends(columns, rows))
    x = Axis(limits=(-0.03, 1.03), ticks=((0.0, "least allowed"), (1.0, "greatest allowed")))
    y = named_axis([shortened(column.heading, 60) for column in columns], lambda w: wrapped(w, 26))
    return Chart(
        "parallel_coordinates",
        "A line for each design of the front over all variables and objectives.",
        "Parallel coordinates of the front: each scale goes from the least to the greatest "
        "value of the allowed designs.",
        (Panel(x, y, marks, height=0.7 + 0.45 * len(columns)),),
    )


def _ends(columns: Sequence[Column], rows: IndexArray) -> Iterator[Mark]:
    """Yield the least and the greatest value of each column below its scale."""
    for row, column in enumerate(columns):
        values = column.values[rows]
        for share, value in ((0.0, np.nanmin(values)), (1.0, np.nanmax(values))):
            words = column.words[round(float(value))] if column.words else f"{value:.3g}"
            align: Literal["left", "right"] = "right" if share else "left"
            yield Note(share, float(row), words, "#555555", align, (0.0, -12.0))


def main_effects_charts(
    variables: Sequence[Column], objective: Column, number: int
) -> Iterator[Chart]:
    """Yield an objective over variables: median of designs that fill the space, and 80 % of them.

    Designs that failed are not numbers; the number is that of the objective.
    """
    for start in range(0, len(variables), _PANELS):
        yield Chart(
            f"main_effects_{number}_{start // _PANELS + 1}",
            f"Median and middle 80 % of {objective.label} over each variable.",
            f"{objective.heading} over each variable: median and middle 80 % of designs that fill "
            "the design space evenly.",
            tuple(_effect(each, objective) for each in variables[start : start + _PANELS]),
        )


def _effect(variable: Column, objective: Column) -> Panel:
    is_finite = np.isfinite(objective.values) & np.isfinite(variable.values)
    middle, (low, median, high) = _by_bin(variable.values[is_finite], objective.values[is_finite])
    line = Line(middle, median, "median, middle 80 % of the designs", (low, high), _BLUE, "-", "o")
    words = tuple((float(n), wrapped(word, 14)) for n, word in enumerate(variable.words))
    x = Axis(wrapped(variable.heading, 60), ticks=words or None)
    y = Axis(wrapped(shortened(objective.heading, 50), 18))
    further_lines = max((word.count("\n") for _, word in words), default=0)
    return Panel(x, y, (line,), height=1.8 + 0.15 * further_lines)


def _by_bin(values: Array, objective: Array) -> tuple[Array, Array]:
    """Return middles of the bins of a variable, and quantiles 10, 50 and 90 %, shape (3, bin)."""
    levels, number = np.unique(values, return_inverse=True)
    if len(levels) > _BINS:
        edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, _BINS + 1)))
        number = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    bins = [number == filled for filled in np.unique(number)]
    middle = np.array([np.median(values[rows]) for rows in bins])
    return middle, np.array([np.quantile(objective[rows], (0.1, 0.5, 0.9)) for rows in bins]).T


def _share(values: Array, rows: IndexArray) -> Array:
    """Return values from 0, the least of some rows, to 1, the greatest of them."""
    low, high = float(np.nanmin(values[rows])), float(np.nanmax(values[rows]))
    return (values - low) / (high - low) if high > low else np.full(len(values), 0.5)


def _thinned(rows: IndexArray, most: int = _MOST_POINTS) -> IndexArray:
    """Return at most so many rows, evenly chosen."""
    if len(rows) <= most:
        return rows
    return rows[np.linspace(0, len(rows) - 1, most).round().astype(np.intp)]
