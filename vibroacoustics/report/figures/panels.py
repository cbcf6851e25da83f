"""Panels with their titles, labels and legend, and what several figures paint in them."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from ...base.arrays import Array
from .style import (
    COLOURS,
    MARKERS,
    WIDTH_INCH,
    draw,
    frequency_ticks,
    legend_below,
    line_looks,
    wrap,
)

Item = TypeVar("Item")
_QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""
_DECADES: Final = 100.0
"""Range of a logarithmic axis from which on it has ticks at powers of ten alone."""


def each_panel(
    items: Iterable[Item],
    height_inch: float,
    paint: Callable[[Axes, Item], None],
    x: str,
    y: str = "",
    title: Callable[[Item], str] | None = None,
    columns: int = 0,
    rows: int = 0,
    width_inch: float = WIDTH_INCH,
    **share: Any,
) -> Figure:
    """A panel for each item, below each other, with a legend of the first panel below.

    Parameters
    ----------
    items : what the panels are of
    height_inch : of a panel
    paint : paints an item
    x, y : labels of the axes
    title : of an item's panel
    columns, rows : of the legend; no columns for no legend
    width_inch : of the figure
    share : which axes the panels have in common, as `Figure.subplots` takes it
    """

    shown = list(items)

    def paint_all(panels: Sequence[Axes]) -> None:
        for axes, item in zip(panels, shown, strict=True):
            paint(axes, item)
            if title:
                axes.set_title(title(item), loc="left")
            if y:
                axes.set_ylabel(y)
        panels[-1].set_xlabel(x)
        if columns:
            legend_below(panels[0], columns)

    return draw(len(shown), height_inch, paint_all, rows, width_inch, **share)


def one_panel(
    height_inch: float,
    paint: Callable[[Axes], None],
    x: str,
    y: str = "",
    title: str = "",
    columns: int = 0,
    rows: int = 0,
    width_inch: float = WIDTH_INCH,
) -> Figure:
    """A single panel; the parameters are those of `each_panel`."""
    return each_panel(
        [title], height_inch, lambda axes, _: paint(axes), x, y, str, columns, rows, width_inch
    )


def in_rpm(speed: float) -> str:
    """Title of the panel of a speed."""
    return f"{speed:g} rpm"


def lines(
    axes: Axes, x: Any, names: Sequence[str], curves: Iterable[Any], marked: bool = False
) -> None:
    """A line for each name, each in its look, with markers where they are wanted."""
    looks = zip(names, curves, line_looks(len(names)), strict=True)
    for number, (name, curve, look) in enumerate(looks):
        marks = {"marker": MARKERS[number % len(MARKERS)], "markersize": 3.5}
        axes.plot(x, curve, label=name, **(look | marks if marked else look))


def third_octaves(
    axes: Axes, band_hz: Array, names: Sequence[str], curves: Iterable[Array]
) -> None:
    """Spectra over the frequency of the bands."""
    axes.set_xscale("log")
    lines(axes, band_hz, names, curves, marked=True)
    frequency_ticks(axes, band_hz)


def band(axes: Axes, x: Array, low: Any, high: Any) -> None:
    """A 90 % band."""
    axes.fill_between(x, low, high, color=COLOURS[1], alpha=0.3, linewidth=0.0, label="90 % band")


def named_rows(axes: Axes, names: Sequence[str], width: int = 20) -> None:
    """A row for each name, the first on top."""
    axes.set_yticks(range(len(names)), [wrap(name, width) for name in names])
    axes.set_ylim(len(names) - 0.5, -0.5)


def stacked_bars(axes: Axes, names: Sequence[str], parts: Iterable[tuple[str, Any, Array]]) -> None:
    """A bar for each name, of parts that add up to one: label, colour, sizes (name,)."""
    left: Array = np.zeros(len(names))
    for label, colour, sizes in parts:
        axes.barh(range(len(names)), sizes, left=left, color=colour, label=label)
        left = left + sizes
    axes.set_yticks(range(len(names)), [wrap(name) for name in names])
    axes.invert_yaxis()
    axes.set_xlim(0.0, 1.0)


def level_map(axes: Axes, x: Any, y: Any, level_db: Array, range_db: float, label: str) -> None:
    """Levels as colours, down to a range below the highest, with their scale beside them."""
    top = float(level_db.max())
    shown = axes.pcolormesh(
        x, y, level_db, vmin=top - range_db, vmax=top, shading="nearest", rasterized=True
    )
    figure = axes.get_figure()
    if figure is not None:
        figure.colorbar(shown, ax=axes, label=label)
    axes.grid(visible=False)


def logarithmic(axes: Axes, sizes: Array, limits: Array | None = None) -> None:
    """Logarithmic axis over sizes, unless they are next to nothing, and over their limits."""
    known = sizes[np.isfinite(sizes)]
    if known.size and known.max() > 0.0:
        highest = float(known.max())
        allowed = [] if limits is None else limits[np.isfinite(limits)]
        bottom = max(0.5 * float(known.min()), _QUIETEST * highest)
        bottom, top = min([bottom, *0.5 * np.asarray(allowed)]), 2.0 * max([highest, *allowed])
        axes.set_yscale("log")
        axes.set_ylim(bottom, top)
        if top > _DECADES * bottom:
            axes.yaxis.set_minor_locator(NullLocator())  # they take half the time of a picture


def third_octave_ticks(axes: Axes, band_hz: Array | Sequence[float]) -> None:
    """Names of every third band, where the bands are numbered from 0."""
    axes.set_xticks(range(0, len(band_hz), 3), [f"{band:g}" for band in band_hz[::3]])
