"""One look for all figures: narrow, so that they can be read on a phone; colour-blind safe."""

import io
import re
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from itertools import cycle, islice
from typing import Any, Final

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import LogLocator, MaxNLocator
from PIL import Image

from ...base.arrays import Array
from ..charts.picture import Picture as Picture  # noqa: PLC0414
from ..file_names import file_name as file_name  # noqa: PLC0414
from ..file_names import numbered as numbered  # noqa: PLC0414

WIDTH_INCH: Final = 4.6
FULL_WIDTH_INCH: Final = 9.2
"""Of figures over the speed where there is room."""
DOTS_PER_INCH: Final = 160
LEGEND_ROW_INCH: Final = 0.2

COLOURS: Final = (
    "#000000",
    "#d55e00",
    "#e69f00",
    "#0072b2",
    "#cc79a7",
    "#009e73",
    "#56b4e9",
    "#7a5195",
)
"""Okabe & Ito's palette without its yellow, and a violet."""

DASHES: Final = ("-", "--", "-.", ":")
MARKERS: Final = ("o", "s", "^", "D", "v", "P")

STYLE: Final[dict[str, Any]] = {
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.0,
    "legend.fontsize": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "lines.linewidth": 1.6,
    "axes.unicode_minus": True,
}


class Drawing(Figure):
    """A figure that a notebook shows as it is; it belongs to no window and no global state."""

    def _repr_png_(self) -> bytes:
        return png(self)


NOTHING_TO_DRAW: Final = "Every value is too small to draw."
PALETTE: Final = 255
"""Colours of a small picture."""
FAST: Final = {"compress_level": 1}
"""Larger files by a third, written in half the time."""


def draw(
    panels: int,
    panel_height_inch: float,
    paint: Callable[[Sequence[Axes]], None],
    legend_rows: int = 1,
    width_inch: float = WIDTH_INCH,
    **share: Any,
) -> Figure:
    """Panels below each other, painted by `paint`, with room for a legend below."""
    height_inch = panel_height_inch * panels + LEGEND_ROW_INCH * (legend_rows + 1)

    def paint_panels(figure: Figure) -> None:
        # Titles stand on their panels: looking for what they could meet takes a sixth of the time.
        with matplotlib.rc_context({"axes.titley": 1.0}):
            paint(figure.subplots(panels, 1, squeeze=False, **share)[:, 0])

    return render(width_inch, height_inch, paint_panels)


def render(width_inch: float, height_inch: float, paint: Callable[[Figure], None]) -> Figure:
    """A figure of this size in the common style, painted by `paint` and laid out."""
    with _style():
        layout = ConstrainedLayoutEngine(w_pad=0.08, h_pad=0.08)
        figure = Drawing(figsize=(width_inch, height_inch), dpi=DOTS_PER_INCH, layout=layout)
        FigureCanvasAgg(figure)
        paint(figure)
        for axes in figure.axes:
            _say_where_empty(axes)
        layout.execute(figure)  # once; saving with a layout engine would draw everything twice
        figure.set_layout_engine(None)
    return figure


def _say_where_empty(axes: Axes) -> None:
    """A sentence on a logarithmic axis without a value above zero, which cannot be drawn."""
    smallest = {"x": axes.dataLim.minposx, "y": axes.dataLim.minposy}
    scales = {"x": axes.get_xscale(), "y": axes.get_yscale()}
    empty = [name for name in "xy" if scales[name] == "log" and not np.isfinite(smallest[name])]
    if empty:
        axes.set(**{f"{name}scale": "linear" for name in empty})
        axes.set(**{f"{name}ticks": [] for name in empty if name == "x"})
        axes.text(0.5, 0.5, NOTHING_TO_DRAW, transform=axes.transAxes, ha="center", va="center")


def in_both_widths(name: str, alt: str, caption: str, make: Callable[[float], Figure]) -> Picture:
    """A picture that is narrow on a phone and as wide as the page where there is room.

    Parameters
    ----------
    name, alt, caption : of the picture
    make : draws the figure at a width, inch
    """
    return Picture(name, alt, caption, small_png(make(FULL_WIDTH_INCH)), wide=True)


def small_png(figure: Figure) -> bytes:
    """PNG of a figure with a palette: a third of the size, no difference that the eye sees."""
    content = io.BytesIO()
    with Image.open(io.BytesIO(png(figure))) as drawn:
        reduced = drawn.convert("RGB").quantize(
            PALETTE, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE
        )
        reduced.save(content, "png", compress_level=9)
    return content.getvalue()


def png(figure: Figure) -> bytes:
    """PNG of a figure; the same figure gives the same bytes."""
    content = io.BytesIO()
    with _style():
        figure.savefig(content, format="png", metadata={"Software": None}, pil_kwargs=FAST)
    return content.getvalue()


def _style() -> AbstractContextManager[None]:
    """The common style, whatever the user has set."""
    return matplotlib.rc_context({**matplotlib.rcParamsDefault, "backend": "agg", **STYLE})


def line_looks(count: int) -> list[dict[str, Any]]:
    """Colour and dash of `count` lines; the dashes keep lines apart that lie on each other."""
    colours = islice(cycle(COLOURS), count)
    return [
        {"color": colour, "linestyle": DASHES[(index + index // len(COLOURS)) % len(DASHES)]}
        for index, colour in enumerate(colours)
    ]


def frequency_ticks(axes: Axes, frequency_hz: Array) -> None:
    """Ticks at 1, 2, 5, 10 … Hz within the range, as plain numbers; no minor ticks."""
    ticks = [digit * 10**power for power in range(6) for digit in (1, 2, 5)]
    shown = [tick for tick in ticks if frequency_hz.min() <= tick <= frequency_hz.max()]
    axes.set_xticks(shown, [f"{tick}" for tick in shown])
    axes.minorticks_off()


def logarithmic_ticks(axes: Axes) -> None:
    """Ticks of the abscissa at powers of ten; also at 2 and 5 times where it spans few of them."""
    axes.minorticks_off()
    lowest, highest = axes.get_xlim()
    if highest < 100.0 * lowest:
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter("{x:g}")


def whole_number_ticks(axes: Axes) -> None:
    """Ticks of the abscissa at whole numbers only, as of orders."""
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))


def shade(axes: Axes, first: float, last: float) -> None:
    """A band over a range of the abscissa."""
    axes.axvspan(first, last, color=COLOURS[1], alpha=0.13, lw=0)


def legend_below(axes: Axes, columns: int = 2) -> None:
    """Legend outside of the axes, below the last panel."""
    figure = axes.get_figure()
    handles, labels = axes.get_legend_handles_labels()
    if figure is not None and handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=columns, frameon=False)


def wrap(name: str, width: int = 20) -> str:
    """A long name on several lines, broken at its hyphens and spaces where it can be."""
    lines = [""]
    for piece in re.findall(r"[^\s\-_]+[\s\-_]*|[\s\-_]+", name):
        for part in (piece[start : start + width] for start in range(0, len(piece), width)):
            if len(lines[-1]) + len(part.rstrip()) > width:
                lines.append("")
            lines[-1] += part
    return plain("\n".join(line.rstrip() for line in lines))


def plain(text: str) -> str:
    """Text that matplotlib does not take for mathematics."""
    return text.replace("$", r"\$")


def shortened(text: str, width: int = 50) -> str:
    """Text for a title or a legend: a name without end leaves no room for the figure."""
    return plain(text if len(text) <= width else f"{text[: width - 1]}…")
