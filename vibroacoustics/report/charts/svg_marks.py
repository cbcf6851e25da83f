"""Marks of a chart in SVG, each with what the legend draws of it."""

from collections.abc import Sequence
from functools import singledispatch
from typing import Any, Final, NamedTuple

import numpy as np

from .colours import numbers
from .frame import Frame
from .layout import COLOURS, Box
from .marks import Area, Bars, Image, Line, Mark, Note, Points, Segments, Span
from .svg_image import image
from .svg_parts import INK, head, markers, pairs, path, rectangle, thinned, words

DASHES: Final = {"-": "", "--": "7 4", "-.": "8 3 2 3", ":": "2 3"}
MARKERS: Final = ("o", "s", "^", "D", "v", "P")


class Look(NamedTuple):
    """Colour, dash and marker that a mark has if it names none."""

    colour: str
    dash: str
    marker: str


def looks_of(marks: Sequence[Mark]) -> list[Look]:
    """Colour, dash and marker by the number of the mark among those that have them."""
    looks, number = [], 0
    for mark in marks:
        dash = list(DASHES)[(number + number // len(COLOURS)) % len(DASHES)]
        looks.append(Look(COLOURS[number % len(COLOURS)], dash, MARKERS[number % len(MARKERS)]))
        number += isinstance(mark, Line | Points | Bars) and not mark.colour
    return looks


@singledispatch
def draw_mark(mark: Any, frame: Frame, look: Look) -> tuple[str, str]:
    """Return a mark as SVG and what the legend draws of it."""
    raise TypeError(f"{mark!r}: is no mark")


@draw_mark.register
def _line(mark: Line, frame: Frame, look: Look) -> tuple[str, str]:
    colour = mark.colour or look.colour
    x, y = np.broadcast_arrays(numbers(mark.x), numbers(mark.y))
    parts = []
    if mark.interval is not None:
        low, high = map(numbers, mark.interval)
        edges = [thinned(frame.points(x, end)) for end in (high, low)]
        around = np.concatenate([edges[0], edges[1][::-1]])
        around = around[np.isfinite(around).all(axis=1)]
        parts.append(f'<path d="{path(around)}Z" fill="{colour}" fill-opacity=".2"/>')
    dash = DASHES[mark.dash or look.dash]
    stroke = f'fill="none" stroke="{colour}" stroke-width="{1.1 * mark.width:.2g}"'
    stroke += f' stroke-dasharray="{dash}"' if dash else ""
    points = frame.points(x, y)
    parts.append(f'<path d="{path(thinned(points))}" {stroke} stroke-linejoin="round"/>')
    key = f'<path d="M0 0H26" {stroke}/>'
    if mark.marker:
        parts.append(markers(points, mark.marker, 2.4, colour, True))
        key += markers(np.array([[13.0, 0.0]]), mark.marker, 2.4, colour, True)
    return "".join(parts), key


@draw_mark.register
def _points(mark: Points, frame: Frame, look: Look) -> tuple[str, str]:
    colour, shape = mark.colour or look.colour, mark.marker or look.marker
    points, parts = frame.points(mark.x, mark.y), []
    if mark.stems:
        bottom = np.stack([points[:, 0], np.full(len(points), frame.box.y + frame.box.height)], -1)
        parts.append(f'<path d="{pairs(bottom, points)}" stroke="{colour}" stroke-opacity=".45"/>')
    if mark.interval is not None:
        low, high = (frame.points(mark.x, end) for end in mark.interval)
        parts.append(f'<path d="{pairs(low, high)}" stroke="{colour}" stroke-width="1.2"/>')
    size = 0.62 * mark.size
    parts.append(markers(points, shape, size, colour, mark.filled))
    return "".join(parts), markers(np.array([[13.0, 0.0]]), shape, size, colour, mark.filled)


@draw_mark.register
def _bars(mark: Bars, frame: Frame, look: Look) -> tuple[str, str]:
    colour, half = mark.colour or look.colour, 0.5 * mark.thickness
    position, size, base = np.broadcast_arrays(*map(numbers, (mark.position, mark.size, mark.base)))
    along, across = (position - half, position + half), (base, base + size)
    if mark.upright:
        first, last = (frame.points(x, y) for x, y in zip(along, across, strict=True))
    else:
        first, last = (frame.points(x, y) for x, y in zip(across, along, strict=True))
    finite = np.isfinite(first).all(axis=1) & np.isfinite(last).all(axis=1)
    ends = zip(first[finite], last[finite], strict=True)
    shape = "".join(f"M{x:.1f} {y:.1f}H{x2:.1f}V{y2:.1f}H{x:.1f}Z" for (x, y), (x2, y2) in ends)
    parts = [f'<path d="{shape}" fill="{colour}"/>']
    if mark.interval is not None:
        low, high = map(numbers, mark.interval)
        ends_at = [(position, end) if mark.upright else (end, position) for end in (low, high)]
        rules = pairs(*(frame.points(x, y) for x, y in ends_at))
        parts.append(f'<path d="{rules}" stroke="{INK}"/>')
    return "".join(parts), f'<path d="M0-5H26V5H0Z" fill="{colour}"/>'


@draw_mark.register
def _image(mark: Image, frame: Frame, look: Look) -> tuple[str, str]:
    return image(mark, frame), ""


@draw_mark.register
def _segments(mark: Segments, frame: Frame, look: Look) -> tuple[str, str]:
    (x, y), (x_end, y_end) = frame.ends(mark)
    first, last = frame.points(x, y), frame.points(x_end, y_end)
    dash = DASHES[mark.dash]
    stroke = f'fill="none" stroke="{mark.colour}" stroke-width="{mark.width:g}"'
    stroke += f' stroke-dasharray="{dash}"' if dash else ""
    heads = "".join(head(*ends, mark.colour) for ends in zip(first, last, strict=True))
    shape = f'<path d="{pairs(first, last)}" {stroke}/>{heads if mark.arrow else ""}'
    return shape, f'<path d="M0 0H26" {stroke}/>'


@draw_mark.register
def _area(mark: Area, frame: Frame, look: Look) -> tuple[str, str]:
    looks = f'fill="{mark.fill or "none"}" fill-opacity="{mark.opacity:g}"'
    looks += f' stroke="{mark.colour or "none"}"'
    looks += f' stroke-dasharray="{DASHES[mark.dash]}"' if DASHES[mark.dash] else ""
    shape = f'<path d="{path(frame.points(mark.x, mark.y))}Z" {looks}/>'
    return shape, f'<path d="M0-5H26V5H0Z" {looks}/>'


@draw_mark.register
def _span(mark: Span, frame: Frame, look: Look) -> tuple[str, str]:
    x, y, width, height = frame.box
    scale = frame.x if mark.along == "x" else frame.y
    low, high = np.sort(np.clip(scale.share([mark.low, mark.high]), 0.0, 1.0))
    box = Box(x + width * low, y, width * (high - low), height)
    if mark.along == "y":
        box = Box(x, y + height * (1.0 - high), width, height * (high - low))
    looks = f'fill="{mark.colour}" fill-opacity=".14"'
    return f'<path d="{rectangle(box)}" {looks}/>', f'<path d="M0-5H26V5H0Z" {looks}/>'


@draw_mark.register
def _note(mark: Note, frame: Frame, look: Look) -> tuple[str, str]:
    ((x, y),) = frame.points([mark.x], [mark.y])
    anchor = {"left": "start", "center": "middle", "right": "end"}[mark.align]
    x, y = x + 1.33 * mark.shift[0], y - 1.33 * mark.shift[1]
    return words(
        x, y, mark.words, anchor, fill=mark.colour, font_size=f"{1.33 * mark.size:.3g}"
    ), ""
