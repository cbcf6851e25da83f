"""Pictures of a machine's inner curves, from what their dataset says of itself."""

from textwrap import fill
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array
from ...base.curve_dataset import axis_words, is_words, shown, shown_label
from ...base.errors import ParameterError
from ...base.units import shaft_frequency_hz
from .style import (
    COLOURS,
    LEGEND_ROW_INCH,
    STYLE,
    WIDTH_INCH,
    Picture,
    legend_below,
    line_looks,
    plain,
    png,
    render,
    wrap,
)

TITLE_WIDTH: Final = 62
LABEL_WIDTH: Final = 24
PANEL_INCH: Final = 2.2
ORBIT_INCH: Final = 4.2
ORBIT_TICKS: Final = (-1.0, -0.5, 0.0, 0.5, 1.0)
MOST_MARKED: Final = 12
"""Points of a line that has a marker on each."""
LABELLED: Final = (0.1, 0.8)
"""Heights, over that of the panel, between which a shaft order has its label."""
DEGREES_PER_TICK: Final = 60.0
LEGEND_COLUMNS: Final = 2


def curve_figures(dataset: xr.Dataset) -> list[Picture]:
    """A picture of every curve of a dataset of curves."""
    return [
        Picture(str(name), f"{curve.attrs['title']}.", str(curve.attrs["source"]), png(figure))
        for name, curve in dataset.items()
        for figure in [curves(dataset, str(name))]
    ]


def curves(dataset: xr.Dataset, name: str) -> Figure:
    """Figure of one curve of a dataset of curves.

    Parameters
    ----------
    dataset : of `vibroacoustics.curves`, also as read from its file; needs `name`
    name : of the variable

    Raises
    ------
    ParameterError
        The dataset has no such curve.

    Examples
    --------
    >>> inner = va.curves(va.load_study("pipelines/copeland_thesis.toml"))
    >>> va.plot.curves(inner, "ring_force").savefig("ring_force.png")
    """
    if name not in dataset.data_vars or "read_in" not in dataset[name].attrs:
        known = [str(key) for key, variable in dataset.items() if "read_in" in variable.attrs]
        raise ParameterError(f"curve {name}: unknown; allowed {', '.join(known) or 'none'}")
    curve = dataset[name]
    orbit = curve.attrs["picture"] == "orbit"
    named = curve if curve.ndim > 1 + orbit else curve.expand_dims("line")
    families = named if named.ndim > 2 + orbit else named.expand_dims("panel")
    rows = -(-families.shape[1] // LEGEND_COLUMNS) if families.shape[1] > 1 else 0
    height = (ORBIT_INCH if orbit else PANEL_INCH) * families.shape[0]

    def paint(figure: Figure) -> None:
        panels = figure.subplots(families.shape[0], 1, squeeze=False)[:, 0]
        for axes, family, words in zip(panels, families, _words(families), strict=True):
            (_paint_orbit if orbit else _paint_lines)(axes, family)
            axes.set_title(plain(words), loc="left")
        figure.suptitle(_title(curve), x=0.02, ha="left", fontsize=STYLE["axes.titlesize"])
        if rows:
            legend_below(panels[0], LEGEND_COLUMNS)

    return render(WIDTH_INCH, height + LEGEND_ROW_INCH * (rows + 2), paint)


def _paint_lines(axes: Axes, family: xr.DataArray) -> None:
    """Every line of a family over the abscissa; bars where the abscissa is words."""
    abscissa = family[family.dims[-1]]
    values = shown(family)
    if is_words(abscissa):
        _paint_bars(axes, axis_words(abscissa), values[0])
        axes.set_xlabel(plain(shown_label(family)))
        return
    along = shown(abscissa)
    marker = "o" if along.size <= MOST_MARKED else None
    for words, row, look in zip(_words(family), values, line_looks(len(values)), strict=True):
        axes.plot(along, row, marker=marker, markersize=4.0, label=wrap(words, 30), **look)
    for order in np.atleast_1d(family.attrs.get("orders", ())):
        _paint_order(axes, abscissa.values, float(order))
    axes.set_xlabel(plain(shown_label(abscissa)))
    axes.set_ylabel(plain(_on_lines(shown_label(family))))
    axes.set_xlim(along.min(), along.max())
    if abscissa.attrs["read_in"] == "°":
        _degree_ticks(axes, along)


def _on_lines(label: str) -> str:
    """A label on lines short enough for the height of a panel; the unit stays with its word."""
    words, comma, unit = label.partition(", ")
    together = "\u00a0".join([f"{words}{comma.rstrip()}", *unit.split()])
    return fill(together, LABEL_WIDTH)


def _paint_bars(axes: Axes, words: list[str], values: Array) -> None:
    positions = np.arange(len(words))[::-1]
    axes.barh(positions, values, height=0.5, color=COLOURS[3])
    for position, value in zip(positions, values, strict=True):
        shown_value = f"{float(f'{value:.4g}'):g}"
        axes.annotate(
            shown_value, (value, position), (4, 0), textcoords="offset points", va="center"
        )
    axes.set_yticks(positions, [wrap(word, 24) for word in words])
    axes.set_xlim(right=1.2 * float(np.max(values)))
    axes.grid(visible=False, axis="y")


def _paint_order(axes: Axes, speed_rpm: Array, order: float) -> None:
    """A shaft order over the speed, up to the highest frequency that is drawn."""
    top = axes.get_ylim()[1]
    frequency = order * np.vectorize(shaft_frequency_hz)(speed_rpm)
    axes.plot(speed_rpm, frequency, color="#888888", linewidth=1.0, linestyle="--")
    end = int(np.flatnonzero(frequency <= LABELLED[1] * top)[-1])
    if frequency[end] > LABELLED[0] * top:
        end_point = (speed_rpm[end], frequency[end])
        axes.annotate(
            f"{order:g}×",
            end_point,
            (-6, 4),
            textcoords="offset points",
            ha="right",
            color="#555555",
        )
    axes.set_ylim(0.0, top)


def _paint_orbit(axes: Axes, family: xr.DataArray) -> None:
    """y over x of every line, closed, in a circle of one."""
    looks = line_looks(family.shape[0])
    for words, line, look in zip(_words(family), shown(family), looks, strict=True):
        x, y = np.concatenate((line, line[:, :1]), axis=1)
        axes.plot(x, y, label=wrap(words, 30), **look)
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(turn), np.sin(turn), color="#888888", linewidth=1.0, linestyle=":")
    axes.set_aspect("equal")
    axes.set_xticks(ORBIT_TICKS)
    axes.set_yticks(ORBIT_TICKS)
    axes.set_xlabel(plain(f"{shown_label(family)}, along x"))
    axes.set_ylabel(plain("along y"))


def _degree_ticks(axes: Axes, degrees: Array) -> None:
    """Ticks at multiples of 60°, or of 120° over more than a revolution."""
    step = DEGREES_PER_TICK * (2.0 if np.ptp(degrees) > 400.0 else 1.0)
    first, last = np.ceil(degrees.min() / step), np.floor(degrees.max() / step + 0.05)
    axes.set_xticks(step * np.arange(first, last + 1))
    axes.set_xlim(degrees.min(), max(degrees.max(), step * last))


def _words(family: xr.DataArray) -> list[str]:
    """What parts the panels of families or the lines of a family; nothing where there is one."""
    dim = family.dims[0]
    return axis_words(family[dim]) if dim in family.coords else [""]


def _title(curve: xr.DataArray) -> str:
    """Title, and the document and figure that the curve repeats."""
    words = (str(curve.attrs["title"]), f"({curve.attrs['source']})")
    return plain("\n".join(fill(text, TITLE_WIDTH) for text in words))
