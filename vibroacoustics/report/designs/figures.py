"""Figures of many designs: front, parallel coordinates, main effects."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array, IndexArray
from ..figures.style import COLOURS, draw, legend_below, plain, shortened, wrap
from .evaluated import Column, Evaluated

_MOST_POINTS: Final = 20_000
_MOST_LINES: Final = 200
_BINS: Final = 12
_GREY, _BLUE = "#bbbbbb", COLOURS[3]
_OF_BEST: Final = (COLOURS[1], COLOURS[0], COLOURS[5], COLOURS[4], COLOURS[2])


def front_figure(designs: Evaluated) -> Figure:
    """Every objective over the first: all designs that meet the constraints, front, best few.

    Parameters
    ----------
    designs : with two objectives or more
    """
    first, *others = designs.objectives
    allowed = _thinned(np.flatnonzero(designs.met & ~designs.front))
    front = np.flatnonzero(designs.front)

    def paint(panels: Sequence[Axes]) -> None:
        for axes, other in zip(panels, others, strict=True):
            pairs = ((allowed, _GREY, 3.0, "allowed designs"), (front, _BLUE, 8.0, "front"))
            for rows, colour, size, label in pairs:
                axes.scatter(
                    first.values[rows], other.values[rows], s=size, color=colour, label=label,
                    linewidths=0,
                )  # fmt: skip
            _number(axes, designs.best, first, other)
            axes.set_xlabel(plain(first.heading))
            axes.set_ylabel(wrap(other.heading, 34))
            axes.set_xlim(*_near_front(first.values, front))
            axes.set_ylim(*_near_front(other.values, front))
        legend_below(panels[-1], 3)

    return draw(len(others), 2.9, paint, 2 + len(designs.best) // 3)


def _number(axes: Axes, best: IndexArray, first: Column, other: Column) -> None:
    """The best few as open circles, each in its colour."""
    for number, row in enumerate(best, 1):
        axes.scatter(
            first.values[row], other.values[row], s=34, facecolors="none",
            edgecolors=_colour(number), linewidths=1.5, label=f"design {number}", zorder=3,
        )  # fmt: skip


def _colour(number: int) -> str:
    return _OF_BEST[(number - 1) % len(_OF_BEST)]


def _near_front(values: Array, front: IndexArray) -> tuple[float, float]:
    """Limits of an axis that show the front and what is near it."""
    low, high = float(values[front].min()), float(values[front].max())
    span = max(high - low, 1e-3 * abs(low), 1e-12)
    more_is_better = np.median(values) < 0.5 * (low + high)
    near, far = 0.15 * span, 1.5 * span
    return (low - far, high + near) if more_is_better else (low - near, high + far)


def parallel_figure(designs: Evaluated) -> Figure:
    """Parallel coordinates of the front: a line a design over variables and objectives.

    Parameters
    ----------
    designs : the front's designs are drawn, at most 200 of them, and the best few
    """
    columns = (*designs.variables, *designs.objectives)
    front = _thinned(np.flatnonzero(designs.front), _MOST_LINES)
    rows = np.flatnonzero(designs.met)
    scaled = np.stack([_share(column.values, rows) for column in columns])

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        heights = np.arange(len(columns))
        axes.plot(scaled[:, front], -heights, color=_BLUE, linewidth=0.6, alpha=0.45)
        for number, row in enumerate(designs.best, 1):
            axes.plot(
                scaled[:, row], -heights, color=_colour(number), linewidth=1.4, marker=".",
                label=f"design {number}",
            )  # fmt: skip
        axes.set_yticks(-heights, [wrap(shortened(column.heading, 60), 26) for column in columns])
        for height, column in enumerate(columns):
            for share, end in ((0.0, "nanmin"), (1.0, "nanmax")):
                value = float(getattr(np, end)(column.values[rows]))
                words = column.words[round(value)] if column.words else f"{value:.3g}"
                axes.annotate(
                    plain(words), (share, -height), xytext=(0, -10), textcoords="offset points",
                    ha="left" if share == 0.0 else "right", fontsize=7.5, color="#555555",
                )  # fmt: skip
        axes.set_xlim(-0.03, 1.03)
        axes.set_xticks([0.0, 1.0], ["least allowed", "greatest allowed"])
        axes.grid(visible=True, axis="y")
        legend_below(axes, 3)

    return draw(1, 0.7 + 0.45 * len(columns), paint, 1 + len(designs.best) // 3)


def main_effects_figure(variables: Sequence[Column], objective: Column) -> Figure:
    """An objective over variables: median of designs that fill the space, and 80 % of them.

    Parameters
    ----------
    variables, objective : of the same designs; those that failed are not numbers
    """
    sound = np.isfinite(objective.values)

    def paint(panels: Sequence[Axes]) -> None:
        for axes, variable in zip(panels, variables, strict=True):
            there = sound & np.isfinite(variable.values)
            middle, quantiles = _by_bin(variable.values[there], objective.values[there])
            axes.fill_between(middle, quantiles[0], quantiles[2], color=_BLUE, alpha=0.2,
                              linewidth=0, label="middle 80 % of the designs")  # fmt: skip
            axes.plot(middle, quantiles[1], color=_BLUE, marker=".", label="median")
            axes.set_xlabel(plain(variable.heading))
            axes.set_ylabel(wrap(shortened(objective.heading, 60), 24))
            if variable.words:
                axes.set_xticks(range(len(variable.words)), [wrap(w, 14) for w in variable.words])
        legend_below(panels[-1])

    return draw(len(variables), 1.6, paint, sharey=True)


def _by_bin(values: Array, objective: Array) -> tuple[Array, Array]:
    """Middles of the bins of a variable, and quantiles 10, 50 and 90 % in each, shape (3, bin)."""
    levels = np.unique(values)
    if len(levels) <= _BINS:
        groups = [objective[values == level] for level in levels]
        return levels, np.array([np.quantile(group, (0.1, 0.5, 0.9)) for group in groups]).T
    edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, _BINS + 1)))
    number = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    filled = [n for n in range(len(edges) - 1) if (number == n).any()]
    middle = np.array([np.median(values[number == n]) for n in filled])
    quantiles = [np.quantile(objective[number == n], (0.1, 0.5, 0.9)) for n in filled]
    return middle, np.array(quantiles).T


def _share(values: Array, rows: IndexArray) -> Array:
    """Values from 0, the least of some rows, to 1, the greatest of them."""
    low, high = float(np.nanmin(values[rows])), float(np.nanmax(values[rows]))
    return (values - low) / (high - low) if high > low else np.full(len(values), 0.5)


def _thinned(rows: IndexArray, most: int = _MOST_POINTS) -> IndexArray:
    """At most so many rows, evenly chosen."""
    if len(rows) <= most:
        return rows
    return rows[np.linspace(0, len(rows) - 1, most).round().astype(np.intp)]
