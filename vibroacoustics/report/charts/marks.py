"""Charts as data: panels with marks, which paper, page and JSON share.

`picture` renders a chart once; `data` gives the same values as JSON.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, Final, Literal, TypeAlias

import numpy as np

from ...base.arrays import Array

Values: TypeAlias = Any
"""Numbers of shape (n,), as an array or whatever becomes one."""
_FREQUENCY_TICKS: Final = [d * p for p in (1, 10, 100, 1000, 10000) for d in (1, 2, 5)]


@dataclass(frozen=True, eq=False)
class Line:
    """A line through points; values that are not finite break it.

    Attributes
    ----------
    x, y : coordinates of the points, shape (n,)
    label : in the legend; empty for none
    interval : lower and upper values around the line, shape (n,) each
    colour : hexadecimal; empty for the next one of the palette
    dash : dash in the notation of matplotlib; empty for the next one of the palette
    marker : marker of the points; empty for none
    width : width of the line, points
    """

    x: Values
    y: Values
    label: str = ""
    interval: tuple[Values, Values] | None = None
    colour: str = ""
    dash: str = ""
    marker: str = ""
    width: float = 1.6


@dataclass(frozen=True, eq=False)
class Points:
    """Separate points.

    Attributes
    ----------
    x, y : coordinates of the points, shape (n,)
    label, interval, colour : see `Line`
    marker : empty for the next one
    size : points
    filled : or open
    stems : lines from the bottom up to the points
    """

    x: Values
    y: Values
    label: str = ""
    interval: tuple[Values, Values] | None = None
    colour: str = ""
    marker: str = ""
    size: float = 6.0
    filled: bool = True
    stems: bool = False


@dataclass(frozen=True, eq=False)
class Bars:
    """Bars from a base to base plus size.

    Attributes
    ----------
    position : middles along the axis that names the bars, shape (n,)
    size : lengths, shape (n,)
    base : starts, shape (n,) or one
    label, interval, colour : see `Line`
    thickness : along the axis that names the bars
    upright : or from left to right
    """

    position: Values
    size: Values
    base: Values = 0.0
    label: str = ""
    interval: tuple[Values, Values] | None = None
    colour: str = ""
    thickness: float = 0.8
    upright: bool = False


@dataclass(frozen=True, eq=False)
class Image:
    """Values over a plane as colours, with their scale beside it.

    Attributes
    ----------
    x : coordinates of the columns, shape (m,)
    y : coordinates of the rows, shape (n,)
    values : shape (n, m); those that are not finite are left blank
    scale : lowest and highest value of the colours
    label : label of the scale
    contours : values of labelled lines
    """

    x: Values
    y: Values
    values: Values
    scale: tuple[float, float]
    label: str
    contours: tuple[float, ...] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """Ends of the scale, apart where all values are equal."""
        low, high = self.scale
        return (low, high) if high > low else (low - 0.5, low + 0.5)


@dataclass(frozen=True, eq=False)
class Segments:
    """Straight lines between pairs of points: limits, stems, rules, arrows.

    Attributes
    ----------
    x, y : start of each, shape (n,); not finite for an end of the axis
    x_end, y_end : end of each, shape (n,)
    label : in the legend; empty for none
    colour, dash, width : see `Line`
    arrow : with a head at the end
    """

    x: Values
    y: Values
    x_end: Values
    y_end: Values
    label: str = ""
    colour: str = "#000000"
    dash: str = "-"
    width: float = 1.0
    arrow: bool = False


@dataclass(frozen=True, eq=False)
class Area:
    """A closed outline, filled or not.

    Attributes
    ----------
    x, y : corners, shape (n,)
    label : in the legend; empty for none
    fill, colour : fill and colour of the area and of its outline; empty for none
    dash : dash of the outline
    opacity : opacity of the fill
    """

    x: Values
    y: Values
    label: str = ""
    fill: str = ""
    colour: str = ""
    dash: str = "-"
    opacity: float = 1.0


@dataclass(frozen=True)
class Span:
    """A shaded range of an axis.

    Attributes
    ----------
    low, high : ends
    label : in the legend; empty for none
    colour : hexadecimal
    along : the axis
    """

    low: float
    high: float
    label: str = ""
    colour: str = "#d55e00"
    along: Literal["x", "y"] = "x"


@dataclass(frozen=True)
class Note:
    """Words at a point.

    Attributes
    ----------
    x, y : coordinates of the point
    words : text
    colour : hexadecimal
    align : which end of the words is at the point
    shift : right and up, points
    size : size of the letters, points
    """

    x: float
    y: float
    words: str
    colour: str = "#000000"
    align: Literal["left", "center", "right"] = "left"
    shift: tuple[float, float] = (0.0, 0.0)
    size: float = 7.5


Mark: TypeAlias = Line | Points | Bars | Image | Segments | Area | Span | Note


@dataclass(frozen=True)
class Axis:
    """An axis of a panel.

    Attributes
    ----------
    label : quantity and unit
    scale : linear or logarithmic
    limits : lowest and highest value; none for those of the marks
    ticks : values with their words; none for round numbers
    integer : ticks at whole numbers alone
    """

    label: str = ""
    scale: Literal["linear", "log"] = "linear"
    limits: tuple[float | None, float | None] | None = None
    ticks: tuple[tuple[float, str], ...] | None = None
    integer: bool = False


@dataclass(frozen=True, eq=False)
class Panel:
    """Axes with marks.

    Attributes
    ----------
    x, y : axes; of a polar panel angle in degrees and radius
    marks : in the order in which they are drawn
    title : above it
    height : inch
    equal : one scale for both axes
    polar : angles run from the right, counter-clockwise
    """

    x: Axis
    y: Axis
    marks: tuple[Mark, ...]
    title: str = ""
    height: float = 2.4
    equal: bool = False
    polar: bool = False


@dataclass(frozen=True, eq=False)
class Chart:
    """A figure as data.

    Attributes
    ----------
    name : name of its file, without ending
    alt : text in its place
    caption : below it
    panels : row by row
    columns : panels side by side
    title : above all panels
    wide : whether it is as wide as a page, or half
    legend : names of the marks below the panels
    """

    name: str
    alt: str
    caption: str
    panels: tuple[Panel, ...]
    columns: int = 1
    title: str = ""
    wide: bool = False
    legend: bool = True

    def data(self) -> dict[str, Any]:
        """Return the chart as plain values for JSON; None for what is not finite."""
        return {part.name: _plain(getattr(self, part.name)) for part in fields(self)}


def numbers(values: Values) -> Array:
    """Return values as an array of floating-point numbers."""
    return np.asarray(values, dtype=float)


def named_axis(names: Sequence[str], write: Callable[[str], str] = str) -> Axis:
    """Return an axis with a row for each name, broken into lines, the first on top."""
    ticks = tuple((float(row), write(name)) for row, name in enumerate(names))
    return Axis(limits=(len(names) - 0.5, -0.5), ticks=ticks)


def frequency_axis(label: str, frequency_hz: Values) -> Axis:
    """Return a logarithmic axis of frequencies, with ticks at 1, 2, 5, 10 … 1k."""
    low, high = float(np.min(frequency_hz)), float(np.max(frequency_hz))
    named = {tick: f"{tick // 1000}k" if tick >= 1000 else str(tick) for tick in _FREQUENCY_TICKS}
    shown = tuple((float(tick), word) for tick, word in named.items() if low <= tick <= high)
    return Axis(label, "log", (low / 1.05, high * 1.05), shown)


def lines(x: Values, named: Iterable[tuple[str, Values]], marker: str = "") -> tuple[Line, ...]:
    """Return a line for each name and its values."""
    return tuple(Line(x, y, name, marker=marker) for name, y in named)


def _plain(value: object) -> object:
    if is_dataclass(value):
        of_mark = {"mark": type(value).__name__.lower()} if isinstance(value, Mark) else {}
        return of_mark | {part.name: _plain(getattr(value, part.name)) for part in fields(value)}
    if isinstance(value, tuple | list):
        return [_plain(part) for part in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    if isinstance(value, str | bool | int | float | None):
        return value
    return _plain(np.asarray(value).tolist())
