"""Charts of a machine's inner curves, from what their dataset says of itself."""

from collections.abc import Iterator
from textwrap import fill
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.curves import axis_words, is_words, shown, shown_label
from ...base.errors import ParameterError
from ...base.units import shaft_frequency_hz
from ..charts.axes import stacked, ticks_at
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Bars, Chart, Line, Mark, Note, Panel, lines, named_axis
from .levels_over_speed import FEW_POINTS

TITLE_WIDTH: Final = 62
LABEL_WIDTH: Final = 24
PANEL_INCH: Final = 2.4
ORBIT_INCH: Final = 4.6
ORBIT_TICKS: Final = (-1.0, -0.5, 0.0, 0.5, 1.0)
LABELLED: Final = (0.1, 0.8)
"""Heights, over that of the panel, between which a shaft order has its label."""
DEGREES_PER_TICK: Final = 60.0
_GREY: Final = "#888888"


def curve_charts(dataset: xr.Dataset) -> list[Chart]:
    """Return a chart of every curve of a dataset of curves."""
    return [curves(dataset, str(name)) for name in dataset.data_vars]


def curves(dataset: xr.Dataset, name: str | None = None) -> Chart:
    """Chart of one curve of a dataset of curves.

    Parameters
    ----------
    dataset : dataset of `vibroacoustics.curves`, also as read from its file; needs `name`
    name : name of the variable; default: the first
    """
    name = str(next(iter(dataset), "")) if name is None else name
    if name not in dataset.data_vars or "read_in" not in dataset[name].attrs:
        names = [str(key) for key, variable in dataset.items() if "read_in" in variable.attrs]
        raise ParameterError(f"curve {name}: unknown; allowed {', '.join(names) or 'none'}")
    curve = dataset[name]
    orbit = curve.attrs["picture"] == "orbit"
    named = curve if curve.ndim > 1 + orbit else curve.expand_dims("line")
    families = named if named.ndim > 2 + orbit else named.expand_dims("panel")
    make = _orbit_panel if orbit else _panel
    panels = (make(family, words) for family, words in zip(families, _words(families), strict=True))
    title, source = str(curve.attrs["title"]), str(curve.attrs["source"])
    above = "\n".join(fill(text, TITLE_WIDTH) for text in (title, f"({source})"))
    return Chart(name, f"{title}.", source, stacked(panels), title=above)


def _panel(family: xr.DataArray, title: str) -> Panel:
    """Return every line of a family over the abscissa; bars where the abscissa is words."""
    abscissa, values = family[family.dims[-1]], shown(family)
    if is_words(abscissa):
        return _bars(axis_words(abscissa), values[0], shown_label(family), title)
    along = shown(abscissa)
    marker = "o" if along.size <= FEW_POINTS else ""
    marks: list[Mark] = [*lines(along, _named(family, values), marker)]
    y = Axis(_on_lines(shown_label(family)))
    if "orders" in family.attrs:
        top = 1.05 * float(np.nanmax(values))
        y = Axis(y.label, limits=(0.0, top))
        for order in np.atleast_1d(family.attrs["orders"]):
            marks += _order(abscissa.values, float(order), top)
    ends = (float(along.min()), float(along.max()))
    x = Axis(shown_label(abscissa), limits=ends)
    if abscissa.attrs["read_in"] == "°":
        x = _degrees(x.label, *ends)
    return Panel(x, y, tuple(marks), title, PANEL_INCH)


def _on_lines(label: str) -> str:
    """Return a label on lines short enough for a panel; the unit stays with its word."""
    words, comma, unit = label.partition(", ")
    together = "\u00a0".join([f"{words}{comma.rstrip()}", *unit.split()])
    return fill(together, LABEL_WIDTH)


def _bars(words: list[str], values: Array, label: str, title: str) -> Panel:
    position = np.arange(len(words))
    notes = (
        Note(value, row, f"{float(f'{value:.4g}'):g}", shift=(4.0, -3.0))
        for row, value in enumerate(values.tolist())
    )
    x = Axis(label, limits=(None, 1.2 * float(np.max(values))))
    marks: list[Mark] = [Bars(position, values, colour=COLOURS[3], thickness=0.5), *notes]
    height = max(PANEL_INCH, 0.6 + 0.35 * len(words))
    return Panel(x, named_axis([wrapped(word, 24) for word in words]), tuple(marks), title, height)


def _order(speed_rpm: Array, order: float, top: float) -> Iterator[Mark]:
    """Yield a shaft order over the speed, with its name in the panel."""
    frequency = order * np.vectorize(shaft_frequency_hz)(speed_rpm)
    yield Line(speed_rpm, frequency, colour=_GREY, dash="--", width=1.0)
    end = int(np.flatnonzero(frequency <= LABELLED[1] * top)[-1])
    if frequency[end] > LABELLED[0] * top:
        x, y = float(speed_rpm[end]), float(frequency[end])
        yield Note(x, y, f"{order:g}×", "#555555", "right", (-6.0, 4.0), 9.0)


def _orbit_panel(family: xr.DataArray, title: str) -> Panel:
    """Return y over x of every line, closed, in a circle of one."""
    marks = [
        Line(np.append(x, x[0]), np.append(y, y[0]), words)
        for words, (x, y) in _named(family, shown(family))
    ]
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    circle = Line(np.cos(turn), np.sin(turn), colour=_GREY, dash=":", width=1.0)
    labels = (f"{shown_label(family)}, along x", "along y")
    x, y = (Axis(label, ticks=ticks_at(ORBIT_TICKS)) for label in labels)
    return Panel(x, y, (*marks, circle), title, ORBIT_INCH, equal=True)


def _degrees(label: str, first: float, last: float) -> Axis:
    """Return an axis with ticks at multiples of 60°, or of 120° over more than a revolution."""
    step = DEGREES_PER_TICK * (2.0 if last - first > 400.0 else 1.0)
    ticks = step * np.arange(np.ceil(first / step), np.floor(last / step + 0.05) + 1)
    return Axis(label, limits=(first, max(last, float(ticks[-1]))), ticks=ticks_at(ticks))


def _named(family: xr.DataArray, values: Array) -> Iterator[tuple[str, Array]]:
    """Yield the lines of a family, each with its words on lines for the legend."""
    return zip((wrapped(words, 30) for words in _words(family)), values, strict=True)


def _words(family: xr.DataArray) -> list[str]:
    """Return what parts the panels of families or the lines of a family; empty of one."""
    dim = family.dims[0]
    return axis_words(family[dim]) if dim in family.coords else [""]
