"""A chart as a figure of matplotlib, for notebooks and for files of any kind."""

import io
from functools import singledispatch
from typing import Any, Final

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from .frame import Frame, frame_of
from .layout import NOTHING_TO_SHOW, layout, styled
from .marks import (
    Area,
    Bars,
    Chart,
    Image,
    Line,
    Mark,
    Note,
    Panel,
    Points,
    Segments,
    Span,
    numbers,
)
from .svg_marks import BLANK

PIXELS_PER_INCH: Final = 96.0
DOTS_PER_INCH: Final = 160
_STYLE: Final[dict[str, Any]] = {
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
}


class Drawing(Figure):
    """A figure that a notebook shows as it is; it belongs to no window and no global state."""

    def _repr_png_(self) -> bytes:
        content = io.BytesIO()
        self.savefig(content, format="png")
        return content.getvalue()


def figure(chart: Chart) -> Figure:
    """Return a chart as a figure that belongs to no window, whatever style the user has set."""
    placed = layout(chart)
    with matplotlib.rc_context({**matplotlib.rcParamsDefault, "backend": "agg", **_STYLE}):
        size = (placed.width / PIXELS_PER_INCH, placed.height / PIXELS_PER_INCH)
        drawing = Drawing(figsize=size, dpi=DOTS_PER_INCH)
        FigureCanvasAgg(drawing)
        handles: dict[str, Any] = {}
        for panel, box in zip(chart.panels, placed.boxes, strict=True):
            frame = frame_of(panel, box)
            shape = box if frame is None else frame.box
            corner = (shape.x, placed.height - shape.y - shape.height)
            cell = np.array([*corner, shape.width, shape.height])
            cell /= [placed.width, placed.height, placed.width, placed.height]
            axes = drawing.add_axes(tuple(cell), projection="polar" if panel.polar else None)
            axes.set(xlabel=escaped(panel.x.label), ylabel=escaped(panel.y.label))
            if panel.title:
                axes.set_title(escaped(panel.title))
            if frame is None:
                empty = NOTHING_TO_SHOW if panel.marks else ""
                axes.text(0.5, 0.5, empty, transform=axes.transAxes, ha="center", va="center")
                axes.set(xticks=[], yticks=[])
                continue
            handles |= _plot_panel(axes, panel, frame)
        if chart.title:
            drawing.text(0.02, 0.99, escaped(chart.title), va="top", size=9.5)
        shown = [key.name for key in placed.keys if key.name in handles]
        if shown:
            named = ([handles[name] for name in shown], list(map(escaped, shown)))
            drawing.legend(*named, loc="lower center", ncols=len({key.x for key in placed.keys}))
    return drawing


def escaped(text: str) -> str:
    """Return text that matplotlib does not read as mathematics."""
    return text.replace("$", r"\$")


def _plot_panel(axes: Any, panel: Panel, frame: Frame) -> dict[str, Any]:
    """Draw marks and ticks; return what the legend shows of each label."""
    for letter, scale in (("x", frame.x), ("y", frame.y)):
        if letter == "y" or not panel.polar:
            axes.set(**{f"{letter}scale": "log" if scale.logarithmic else "linear"})
            axes.set(**{f"{letter}lim": (scale.low, scale.high)})
    handles: dict[str, Any] = {}
    for mark in styled(panel.marks):
        handle, label = _mark(mark, axes, frame), getattr(mark, "label", "")
        if label and handle is not None:
            handles.setdefault(label, handle)
    for letter, scale in (("x", frame.x), ("y", frame.y)):
        values: Any = [value for value, _ in scale.ticks]
        values = frame.angle(values) if letter == "x" else values
        along = getattr(axes, f"{letter}axis")
        along.set_ticks(values, [escaped(word) for _, word in scale.ticks])
        along.set_minor_locator(NullLocator())
    return handles


@singledispatch
def _mark(mark: Mark, axes: Any, frame: Frame) -> Any:
    """Draw a mark and return what the legend shows of it; None for nothing."""
    raise TypeError(f"{mark!r}: is no mark")


@_mark.register
def _line(mark: Line, axes: Any, frame: Frame) -> Any:
    colour, x = mark.colour, frame.angle(mark.x)
    if mark.interval is not None:
        low, high = map(numbers, mark.interval)
        axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0.0)
    (handle,) = axes.plot(
        x, np.broadcast_to(numbers(mark.y), x.shape), color=colour, lw=mark.width,
        linestyle=mark.dash, marker=mark.marker, markersize=3.5,
    )  # fmt: skip
    return handle


@_mark.register
def _points(mark: Points, axes: Any, frame: Frame) -> Any:
    colour, x, y = mark.colour, frame.angle(mark.x), numbers(mark.y)
    if mark.stems:
        axes.vlines(x, frame.y.low, y, color=colour, alpha=0.45, lw=1.0)
    if mark.interval is not None:
        axes.vlines(x, *map(numbers, mark.interval), color=colour, lw=1.0)
    (handle,) = axes.plot(
        x, y, mark.marker, color=colour, markersize=mark.size,
        fillstyle="full" if mark.filled else "none",
    )  # fmt: skip
    return handle


@_mark.register
def _bars(mark: Bars, axes: Any, frame: Frame) -> Any:
    bars = axes.bar if mark.upright else axes.barh
    position, size, base = map(numbers, (mark.position, mark.size, mark.base))
    handle = bars(position, size, mark.thickness, base, color=mark.colour)
    if mark.interval is not None:
        rules = axes.vlines if mark.upright else axes.hlines
        rules(position, *map(numbers, mark.interval), color="#000000", lw=1.0)
    return handle


@_mark.register
def _image(mark: Image, axes: Any, frame: Frame) -> None:
    x, y, values = map(numbers, (mark.x, mark.y, mark.values))
    low, high = mark.ends
    axes.grid(visible=False)
    axes.set_facecolor(f"#{BLANK}")
    mesh = axes.pcolormesh(x, y, values, vmin=low, vmax=high, shading="nearest", rasterized=True)
    if mark.contours:
        contours = axes.contour(x, y, values, levels=mark.contours, colors="white", linewidths=0.7)
        axes.clabel(contours, fmt="%.0f", fontsize=7.5)
    box, inch = axes.get_position(), 1.0 / axes.figure.get_figwidth()
    bar_axes = axes.figure.add_axes((box.x1 + 0.1 * inch, box.y0, 0.11 * inch, box.height))
    axes.figure.colorbar(mesh, cax=bar_axes).set_label(escaped(mark.label))


@_mark.register
def _segments(mark: Segments, axes: Any, frame: Frame) -> Any:
    (x, y), (x_end, y_end) = frame.ends(mark)
    if mark.arrow:
        for start, end in zip(zip(x, y, strict=True), zip(x_end, y_end, strict=True), strict=True):
            head = {"arrowstyle": "-|>", "color": mark.colour, "lw": mark.width}
            axes.annotate("", end, start, arrowprops={**head, "shrinkA": 0.0, "shrinkB": 0.0})
        return None
    gap = np.full(x.shape, np.nan)
    points = [np.stack(ends, axis=-1).ravel() for ends in ((x, x_end, gap), (y, y_end, gap))]
    (handle,) = axes.plot(*points, color=mark.colour, linestyle=mark.dash, lw=mark.width)
    return handle


@_mark.register
def _area(mark: Area, axes: Any, frame: Frame) -> Any:
    (handle,) = axes.fill(
        numbers(mark.x), numbers(mark.y), facecolor=mark.fill or "none", alpha=mark.opacity,
        edgecolor=mark.colour or "none", linestyle=mark.dash, lw=0.9,
    )  # fmt: skip
    return handle


@_mark.register
def _span(mark: Span, axes: Any, frame: Frame) -> Any:
    shade = axes.axvspan if mark.along == "x" else axes.axhspan
    return shade(mark.low, mark.high, color=mark.colour, alpha=0.14, lw=0)


@_mark.register
def _note(mark: Note, axes: Any, frame: Frame) -> None:
    axes.annotate(
        escaped(mark.words), (mark.x, mark.y), mark.shift, textcoords="offset points",
        ha=mark.align, color=mark.colour, fontsize=mark.size, annotation_clip=True,
    )  # fmt: skip
