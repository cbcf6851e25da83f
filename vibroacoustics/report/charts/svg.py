"""A chart as SVG, sharp at every size, with nothing from elsewhere; finished pictures of a page."""

from typing import Final, Literal, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from pydantic import Base64Bytes

from ..file_names import file_name
from .frame import Frame, frame_of
from .layout import NOTHING_TO_SHOW, ROW, Box, Key, layout, lines, margins, styled
from .marks import Chart, Image, Panel
from .svg_marks import BLANK, colour_bar, mark_content
from .svg_parts import INK, opening, rectangle, upright_words, words

GRID: Final = "#dddddd"


def svg(chart: Chart) -> bytes:
    """Return the SVG of a chart; equal charts give equal bytes."""
    placed = layout(chart)
    parts = [opening(placed.width, placed.height, chart.alt)]
    if chart.title:
        parts.append(words(8.0, 16.0, chart.title, font_size="12.5"))
    keys: dict[str, str] = {}
    for number, (panel, box) in enumerate(zip(chart.panels, placed.boxes, strict=True)):
        parts += _panel(panel, box, f"p{number}", keys)
    parts += [_key(key, keys[key.name]) for key in placed.keys if key.name in keys]
    return "\n".join([*parts, "</svg>\n"]).encode()


def _panel(panel: Panel, box: Box, name: str, keys: dict[str, str]) -> list[str]:
    """Axes, marks and words of a panel; adds each mark's legend."""
    parts = _titles(panel, box)
    frame = frame_of(panel, box)
    if frame is None:
        middle = (box.x + 0.5 * box.width, box.y + 0.5 * box.height)
        return [*parts, words(*middle, NOTHING_TO_SHOW if panel.marks else "", "middle")]
    clip = f'<clipPath id="{name}"><path d="{rectangle(frame.box)}"/></clipPath>'
    marks = []
    for mark in styled(panel.marks):
        shape, key = mark_content(mark, frame)
        marks.append(shape)
        if key and getattr(mark, "label", ""):
            keys.setdefault(mark.label, key)  # type: ignore[union-attr]
    bars = [colour_bar(mark, frame.box) for mark in panel.marks if isinstance(mark, Image)]
    grid = _polar_grid(frame) if panel.polar else _grid(frame, bool(bars))
    group = f'<g clip-path="url(#{name})">' if not panel.polar else "<g>"
    return [*parts, clip, *grid, group, *marks, "</g>", *bars, *_edges(panel, frame)]


def _titles(panel: Panel, box: Box) -> list[str]:
    """Title and labels around the axes."""
    left_margin, _, below, above = margins(panel)
    parts = []
    if panel.title:
        parts.append(words(box.x, box.y - above + 13.0, panel.title, font_size="12.5"))
    if panel.x.label and not panel.polar:
        foot = box.y + box.height + below - ROW * lines(panel.x.label) + 10.0
        parts.append(words(box.x + 0.5 * box.width, foot, panel.x.label, "middle"))
    if panel.y.label and not panel.polar:
        position = (box.x - left_margin + 14.0, box.y + 0.5 * box.height)
        parts.append(upright_words(*position, panel.y.label))
    return parts


def _grid(frame: Frame, blank: bool) -> list[str]:
    """Grid lines at the ticks; a grey ground below an image."""
    x, y, width, height = frame.box
    if blank:
        return [f'<path d="{rectangle(frame.box)}" fill="#{BLANK}"/>']
    across = [x + width * float(frame.x.share(value)) for value, _ in frame.x.ticks]
    down = [y + height * (1.0 - float(frame.y.share(value))) for value, _ in frame.y.ticks]
    shape = "".join(f"M{position:.1f} {y:.1f}v{height:.1f}" for position in across)
    shape += "".join(f"M{x:.1f} {position:.1f}h{width:.1f}" for position in down)
    return [f'<path d="{shape}" stroke="{GRID}" stroke-width=".8"/>']


def _edges(panel: Panel, frame: Frame) -> list[str]:
    """Axes with their ticks and words, on top of the marks."""
    if panel.polar:
        return []
    x, y, width, height = frame.box
    foot = y + height
    shape, parts = f"M{x:.1f} {y:.1f}V{foot:.1f}H{x + width:.1f}", []
    for value, word in frame.x.ticks:
        position = x + width * float(frame.x.share(value))
        shape += f"M{position:.1f} {foot:.1f}v4"
        parts.append(words(position, foot + 16.0, word, "middle"))
    for value, word in frame.y.ticks:
        position = y + height * (1.0 - float(frame.y.share(value)))
        shape += f"M{x:.1f} {position:.1f}h-4"
        middle = position + 4.0 - 7.0 * (lines(word) - 1)
        parts.append(words(x - 7.0, middle, word, "end"))
    return [f'<path d="{shape}" fill="none" stroke="{INK}"/>', *parts]


def _polar_grid(frame: Frame) -> list[str]:
    (x, y), rings = frame.middle, frame.y.ticks
    parts = [
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{frame.radius * float(frame.y.share(value)):.1f}" '
        f'fill="none" stroke="{GRID}"/>'
        for value, _ in rings
    ]
    parts.append(
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{frame.radius:.1f}" fill="none" stroke="{INK}"/>'
    )
    for angle, word in frame.x.ticks:
        turn = np.radians(angle)
        end = (x + frame.radius * np.cos(turn), y - frame.radius * np.sin(turn))
        parts.append(f'<path d="M{x:.1f} {y:.1f}L{end[0]:.1f} {end[1]:.1f}" stroke="{GRID}"/>')
        out = frame.radius + 13.0
        parts.append(words(x + out * np.cos(turn), y - out * np.sin(turn) + 4.0, word, "middle"))
    for value, word in rings:
        ring = frame.radius * float(frame.y.share(value))
        parts.append(words(x + 0.38 * ring + 2.0, y - 0.92 * ring, word, font_size="9.5"))
    return parts


def _key(key: Key, shape: str) -> str:
    name = words(key.x + 32.0, key.y + 12.0, key.name)
    return f'<g transform="translate({key.x:.1f} {key.y + 8.0:.1f})">{shape}</g>{name}'


class Picture(NamedTuple):
    """A finished figure: its file, the text in its place, what is below it, and its width."""

    name: str
    alt: str
    caption: str
    content: Base64Bytes
    ending: Literal["png", "svg"] = "png"
    wide: bool = False


def picture_file(picture: Picture) -> str:
    """Return the name of the file of a picture."""
    return f"{file_name(picture.name)}.{picture.ending}"


_PICTURES: Final[WeakKeyDictionary[Chart, Picture]] = WeakKeyDictionary()


def picture(chart: Chart) -> Picture:
    """Return the picture of a chart, which is drawn once."""
    if chart not in _PICTURES:
        _PICTURES[chart] = Picture(
            chart.name, chart.alt, chart.caption, svg(chart), "svg", chart.wide
        )
    return _PICTURES[chart]
