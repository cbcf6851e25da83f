"""Positions of panels, words and legend of a chart, and ticks of its axes; 96 pixels an inch.

Sizes of words are estimated from their letters, so that a chart is laid out without drawing it.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from ...base.arrays import Array
from .marks import Axis, Bars, Chart, Image, Line, Mark, Panel, Points, numbers

HALF_WIDTH: Final = 442.0
WIDE_WIDTH: Final = 884.0
LETTER: Final = 6.4
"""Mean width of a letter of twelve pixels."""
ROW: Final = 17.0
COLOURS: Final = (
    "#000000", "#d55e00", "#e69f00", "#0072b2", "#cc79a7", "#009e73", "#56b4e9", "#7a5195",
)  # fmt: skip
"""Okabe & Ito's palette without its yellow, and a violet."""
DASHES: Final = ("-", "--", "-.", ":")
_MARKERS: Final = ("o", "s", "^", "D", "v", "P")
NOTHING_TO_SHOW: Final = "Every value is too small to show."
_KEY: Final = 40.0
"""Width of the legend's mark before a name."""
_GAP: Final = 14.0
_BAR: Final = 66.0
_STEPS: Final = (1.0, 2.0, 2.5, 5.0, 10.0)
_FEW_DECADES: Final = 100.0
"""Range of a logarithmic axis up to which it has ticks at 2 and 5 times a power of ten."""
_MOST_POWERS: Final = 6
_MARGIN: Final = 0.04
"""Room between the marks and the ends of an axis, as a share of their range."""
_RAISED: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


Ticks: TypeAlias = tuple[tuple[float, str], ...]
"""Values with their words."""


class Box(NamedTuple):
    """A rectangle, from its upper left corner."""

    x: float
    y: float
    width: float
    height: float


class Key(NamedTuple):
    """A name of the legend at its position."""

    name: str
    x: float
    y: float


class Layout(NamedTuple):
    """Positions of the axes of each panel and of the legend, and the size of the chart."""

    width: float
    height: float
    boxes: tuple[Box, ...]
    keys: tuple[Key, ...]


class Scale(NamedTuple):
    """An axis with its values at the left or lower and at the other end, and its ticks."""

    low: float
    high: float
    ticks: Ticks
    logarithmic: bool

    def share(self, values: Any) -> Array:
        """Return positions from 0 at the low end to 1 at the high end."""
        shown = numbers(values)
        if not self.logarithmic:
            return numbers((shown - self.low) / (self.high - self.low))
        safe = np.where(shown > 0.0, shown, np.nan)
        return numbers(np.log(safe / self.low) / np.log(self.high / self.low))


def layout(chart: Chart) -> Layout:
    """Return where the panels and the legend of a chart are."""
    width = WIDE_WIDTH if chart.wide else HALF_WIDTH
    boxes, top, each = [], 6.0 + ROW * lines(chart.title), width / chart.columns
    for start in range(0, len(chart.panels), chart.columns):
        row = chart.panels[start : start + chart.columns]
        height = max(96.0 * panel.height for panel in row)
        for column, panel in enumerate(row):
            left_margin, right, below, above = margins(panel)
            size = (max(each - left_margin - right, 30.0), max(height - below - above, 30.0))
            boxes.append(Box(column * each + left_margin, top + above, *size))
        top += height
    keys = _keys(chart, width, top + 4.0)
    bottom = max((key.y + ROW * lines(key.name) for key in keys), default=top)
    return Layout(width, bottom + 6.0, tuple(boxes), keys)


def _keys(chart: Chart, width: float, top: float) -> tuple[Key, ...]:
    """Labels of the marks, each once."""
    marks = [mark for panel in chart.panels for mark in panel.marks if not isinstance(mark, Image)]
    labels = dict.fromkeys(str(getattr(mark, "label", "")) for mark in marks)
    names = [name for name in labels if name]
    if not (names and chart.legend):
        return ()
    each = _KEY + LETTER * max(map(letters, names))
    columns = max(1, min(len(names), int((width - 12.0) / each)))
    wide = (width - 12.0) / columns
    height = ROW * max(map(lines, names))
    return tuple(
        Key(name, 10.0 + (number % columns) * min(wide, each + _GAP), top + row * height)
        for number, name in enumerate(names)
        for row in [number // columns]
    )


def styled(marks: Sequence[Mark]) -> list[Mark]:
    """Return marks, with the next colour, dash and marker where they name none."""
    shown: list[Mark] = []
    number = 0
    for mark in marks:
        if isinstance(mark, Line | Points | Bars):
            looks: dict[str, Any] = {"colour": COLOURS[number % len(COLOURS)]}
            if isinstance(mark, Line):
                looks["dash"] = DASHES[(number + number // len(COLOURS)) % len(DASHES)]
            if isinstance(mark, Points):
                looks["marker"] = _MARKERS[number % len(_MARKERS)]
            number += not mark.colour
            shown.append(replace(mark, **{k: getattr(mark, k) or v for k, v in looks.items()}))
        else:
            shown.append(mark)
    return shown


def margins(panel: Panel) -> tuple[float, float, float, float]:
    """Return the room for words around the axes: left, right, below, above."""
    title = ROW * lines(panel.title)
    if panel.polar:
        return 34.0, 34.0, 24.0, 26.0 + title
    named = [letters(word) for _, word in panel.y.ticks or ()]
    ticks = 8.0 + LETTER * max(named, default=7 if panel.y.ticks is None else 0)
    last = letters(panel.x.ticks[-1][1]) if panel.x.ticks else 0
    right = _BAR if any(isinstance(mark, Image) for mark in panel.marks) else 14.0
    right = max(right, 0.5 * LETTER * last + 4.0)
    words = max((lines(word) for _, word in panel.x.ticks or ()), default=1)
    below = 8.0 + 14.0 * words + ROW * lines(panel.x.label)
    return ticks + ROW * lines(panel.y.label) + 4.0, right, below, 8.0 + title


def letters(text: str) -> int:
    """Return the letters of the longest line."""
    return max(map(len, text.split("\n")))


def lines(text: str) -> int:
    """Return the number of lines; none of an empty text."""
    return text.count("\n") + 1 if text else 0


def scale_of(axis: Axis, values: Array, tight: bool = False) -> Scale | None:
    """Return the scale of an axis with the values along it; None where it has nothing to show.

    Without room between the values and the ends if it is tight.
    """
    low, high = axis.limits or (None, None)
    shown = values[np.isfinite(values)]
    logarithmic = axis.scale == "log"
    if logarithmic:
        shown = shown[shown > 0.0]
    if shown.size == 0 and (low is None or high is None):
        return None
    if low is None or high is None:
        ends = (float(shown.min()), float(shown.max()))
        ends = ends if tight else _ends(*ends, logarithmic)
        low, high = (ends[0] if low is None else low), (ends[1] if high is None else high)
    if low == high:
        low, high = low - 0.5, high + 0.5
    ticks = axis.ticks
    if ticks is None:
        ticks = _powers(low, high) if logarithmic else round_ticks(low, high, axis.integer)
    first, last = min(low, high) - 1e-9, max(low, high) + 1e-9
    return Scale(low, high, tuple(t for t in ticks if first <= t[0] <= last), logarithmic)


def _ends(low: float, high: float, logarithmic: bool) -> tuple[float, float]:
    """Ends of an axis somewhat beyond its values."""
    if logarithmic:
        room = max((high / low) ** _MARGIN, 1.05)
        return low / room, high * room
    room = _MARGIN * (high - low) or 0.05 * abs(high) or 0.5
    return (0.0 if low == 0.0 else low - room), (0.0 if high == 0.0 else high + room)


def round_ticks(low: float, high: float, integer: bool = False, most: int = 7) -> Ticks:
    """Return round numbers within a range, with their words."""
    low, high = min(low, high), max(low, high)
    rough = (high - low) / most
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * digit for digit in _STEPS if power * digit >= rough * (1.0 - 1e-9))
    step = max(1.0, float(np.ceil(step))) if integer else step
    values = step * np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1.0)
    digits = max(0, -int(np.floor(np.log10(step) + 1e-9)) + (step / power == _STEPS[2]))
    return tuple((float(value), _number(float(value), digits)) for value in values)


def _number(value: float, digits: int) -> str:
    return f"{value:.{digits}f}".replace("-", "−") if abs(value) > 1e-12 else "0"


def _powers(low: float, high: float) -> Ticks:
    """Powers of ten within a range; 2 and 5 times these too where there are few."""
    few = high < _FEW_DECADES * low
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    step = max(1, (last - first) // _MOST_POWERS)
    digits = (1, 2, 5) if few else (1,)
    values = [digit * 10.0**power for power in range(first, last + 1, step) for digit in digits]
    return tuple((value, _power(value)) for value in values if low <= value <= high)


def _power(value: float) -> str:
    exponent = int(np.floor(np.log10(value) + 1e-9))
    if -3 < exponent < 5:
        return f"{value:g}"
    digit = round(value / 10.0**exponent)
    return f"{f'{digit}·' if digit > 1 else ''}10{str(exponent).translate(_RAISED)}"


def shortened(text: str, width: int = 50) -> str:
    """Return text for a title or a legend: a name without end leaves no room for the figure."""
    return text if len(text) <= width else f"{text[: width - 1]}…"


def wrapped(name: str, width: int = 20) -> str:
    """Return a long name on several lines, broken at its hyphens and spaces where it can be."""
    lines = [""]
    for word in re.findall(r"[^\s\-_]+[\s\-_]*|[\s\-_]+", name):
        for part in (word[start : start + width] for start in range(0, len(word), width)):
            if len(lines[-1]) + len(part.rstrip()) > width:
                lines.append("")
            lines[-1] += part
    return "\n".join(line.rstrip() for line in lines)
