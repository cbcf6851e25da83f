"""Marks of a chart in SVG, each with its legend; colours of an image."""

import base64
import io
from functools import singledispatch
from typing import Any, Final

import numpy as np

from ...base.arrays import Array, IndexArray
from .frame import Frame, edges_of
from .layout import DASHES, Box, Scale, round_ticks
from .marks import Area, Bars, Image, Line, Note, Points, Segments, Span, numbers
from .svg_parts import INK, head, markers, pairs, path, rectangle, thinned, upright_words, words

_ANCHORS: Final = (
    "440154481a6c472f7d41448739568c31688e2a788e23888e"
    "1f988b22a88435b77954c5687ad151a5db36d2e21bfde725"
)
"""Viridis (S. van der Walt, N. Smith, 2015; CC0) at sixteen even steps."""
BLANK: Final = "e6e6e6"
"""Colour of no value."""


def _palette() -> bytes:
    anchors = np.frombuffer(bytes.fromhex(_ANCHORS), np.uint8).reshape(-1, 3).astype(float)
    along = np.linspace(0.0, len(anchors) - 1.0, 255)
    colours = [np.interp(along, np.arange(len(anchors)), channel) for channel in anchors.T]
    return np.stack(colours, axis=1).round().astype(np.uint8).tobytes() + bytes.fromhex(BLANK)


PALETTE: Final = _palette()
"""255 colours from the lowest value to the highest, and that of no value; three bytes each."""


_STROKES: Final = dict(zip(DASHES, ("", "7 4", "8 3 2 3", "2 3"), strict=True))
_KEY: Final = np.array([[13.0, 0.0]])
"""Position of the marker of a mark in the legend."""


@singledispatch
def mark_content(mark: Any, frame: Frame) -> tuple[str, str]:
    """Return a mark as SVG and its legend."""
    raise TypeError(f"{mark!r}: is no mark")


def _dashed(dash: str) -> str:
    return f' stroke-dasharray="{_STROKES[dash]}"' if _STROKES[dash] else ""


@mark_content.register
def _line(mark: Line, frame: Frame) -> tuple[str, str]:
    colour, parts = mark.colour, []
    x, y = np.broadcast_arrays(numbers(mark.x), numbers(mark.y))
    if mark.interval is not None:
        low, high = map(numbers, mark.interval)
        edges = [thinned(frame.points(x, end)) for end in (high, low)]
        around = np.concatenate([edges[0], edges[1][::-1]])
        around = around[np.isfinite(around).all(axis=1)]
        parts.append(f'<path d="{path(around)}Z" fill="{colour}" fill-opacity=".2"/>')
    stroke = f'fill="none" stroke="{colour}" stroke-width="{1.1 * mark.width:.2g}"'
    stroke += _dashed(mark.dash)
    points = frame.points(x, y)
    parts.append(f'<path d="{path(thinned(points))}" {stroke} stroke-linejoin="round"/>')
    key = f'<path d="M0 0H26" {stroke}/>'
    if mark.marker:
        parts.append(markers(points, mark.marker, 2.4, colour, True))
        key += markers(_KEY, mark.marker, 2.4, colour, True)
    return "".join(parts), key


@mark_content.register
def _points(mark: Points, frame: Frame) -> tuple[str, str]:
    colour, points, parts = mark.colour, frame.points(mark.x, mark.y), []
    if mark.stems:
        bottom = np.stack([points[:, 0], np.full(len(points), frame.box.y + frame.box.height)], -1)
        parts.append(f'<path d="{pairs(bottom, points)}" stroke="{colour}" stroke-opacity=".45"/>')
    if mark.interval is not None:
        low, high = (frame.points(mark.x, end) for end in mark.interval)
        parts.append(f'<path d="{pairs(low, high)}" stroke="{colour}" stroke-width="1.2"/>')
    size = 0.62 * mark.size
    shape, key = (markers(p, mark.marker, size, colour, mark.filled) for p in (points, _KEY))
    return "".join([*parts, shape]), key


@mark_content.register
def _bars(mark: Bars, frame: Frame) -> tuple[str, str]:
    half = 0.5 * mark.thickness
    position, size, base = np.broadcast_arrays(*map(numbers, (mark.position, mark.size, mark.base)))
    corners = ((position - half, base), (position + half, base + size))
    first, last = (frame.points(*(xy if mark.upright else xy[::-1])) for xy in corners)
    finite = np.isfinite(first).all(axis=1) & np.isfinite(last).all(axis=1)
    ends = zip(first[finite], last[finite], strict=True)
    shape = "".join(f"M{x:.1f} {y:.1f}H{x2:.1f}V{y2:.1f}H{x:.1f}Z" for (x, y), (x2, y2) in ends)
    picture = f'<path d="{shape}" fill="{mark.colour}"/>'
    if mark.interval is not None:
        ends_at = [(position, end) if mark.upright else (end, position) for end in mark.interval]
        rules = pairs(*(frame.points(x, y) for x, y in ends_at))
        picture += f'<path d="{rules}" stroke="{INK}"/>'
    return picture, f'<path d="M0-5H26V5H0Z" fill="{mark.colour}"/>'


@mark_content.register
def _segments(mark: Segments, frame: Frame) -> tuple[str, str]:
    (x, y), (x_end, y_end) = frame.ends(mark)
    first, last = frame.points(x, y), frame.points(x_end, y_end)
    stroke = f'fill="none" stroke="{mark.colour}" stroke-width="{mark.width:g}"'
    stroke += _dashed(mark.dash)
    heads = "".join(head(*ends, mark.colour) for ends in zip(first, last, strict=True))
    shape = f'<path d="{pairs(first, last)}" {stroke}/>{heads if mark.arrow else ""}'
    return shape, f'<path d="M0 0H26" {stroke}/>'


@mark_content.register
def _area(mark: Area, frame: Frame) -> tuple[str, str]:
    looks = f'fill="{mark.fill or "none"}" fill-opacity="{mark.opacity:g}"'
    looks += f' stroke="{mark.colour or "none"}"{_dashed(mark.dash)}'
    shape = f'<path d="{path(frame.points(mark.x, mark.y))}Z" {looks}/>'
    return shape, f'<path d="M0-5H26V5H0Z" {looks}/>'


@mark_content.register
def _span(mark: Span, frame: Frame) -> tuple[str, str]:
    x, y, width, height = frame.box
    scale = frame.x if mark.along == "x" else frame.y
    low, high = np.sort(np.clip(scale.share([mark.low, mark.high]), 0.0, 1.0))
    if mark.along == "x":
        box = Box(x + width * low, y, width * (high - low), height)
    else:
        box = Box(x, y + height * (1.0 - high), width, height * (high - low))
    looks = f'fill="{mark.colour}" fill-opacity=".14"'
    return f'<path d="{rectangle(box)}" {looks}/>', f'<path d="M0-5H26V5H0Z" {looks}/>'


@mark_content.register
def _note(mark: Note, frame: Frame) -> tuple[str, str]:
    ((x, y),) = frame.points([mark.x], [mark.y])
    anchor = {"left": "start", "center": "middle", "right": "end"}[mark.align]
    x, y, size = x + 1.33 * mark.shift[0], y - 1.33 * mark.shift[1], f"{1.33 * mark.size:.3g}"
    return words(x, y, mark.words, anchor, fill=mark.colour, font_size=size), ""


@mark_content.register
def _image(mark: Image, frame: Frame) -> tuple[str, str]:
    from PIL import Image as Raster

    low, high = mark.ends
    grid = _resampled(mark, frame)
    share = np.clip((grid - low) / (high - low), 0.0, 1.0)
    index = np.where(np.isfinite(grid), np.round(np.nan_to_num(share) * 254.0), 255.0)
    raster = Raster.fromarray(index.astype(np.uint8), "P")
    raster.putpalette(PALETTE)
    content = io.BytesIO()
    raster.save(content, "png", compress_level=6)
    address = base64.b64encode(content.getvalue()).decode()
    box = frame.box
    picture = (
        f'<image x="{box.x:.1f}" y="{box.y:.1f}" width="{box.width:.1f}" '
        f'height="{box.height:.1f}" preserveAspectRatio="none" '
        f'href="data:image/png;base64,{address}"/>{_contours(mark, frame)}'
    )
    return picture, ""


def _resampled(mark: Image, frame: Frame) -> Array:
    """The largest value of each pixel, or the nearest one, the top row first."""
    values = numbers(mark.values)
    rows, columns = numbers(mark.y), numbers(mark.x)
    values = values[np.argsort(rows)][:, np.argsort(columns)]
    wide, high = round(1.5 * frame.box.width), round(1.5 * frame.box.height)
    values = _along(values, np.sort(columns), frame.x, wide, 1)
    return _along(values, np.sort(rows), frame.y, high, 0)[::-1]


def _along(values: Array, middles: Array, scale: Scale, pixels: int, axis: int) -> Array:
    between = 0.5 * (middles[1:] + middles[:-1])
    share = (np.arange(pixels) + 0.5) / pixels
    if scale.logarithmic:
        middle = scale.low * (scale.high / scale.low) ** share
    else:
        middle = scale.low + (scale.high - scale.low) * share
    nearest: IndexArray = np.searchsorted(between, middle)
    first, last = edges_of(middles)
    if len(middles) > pixels:
        starts = np.minimum(nearest, len(middles) - 1)
        step = np.maximum(np.diff(starts, append=starts[-1] + 1), 1)
        pixels_of = (range(s, min(s + n, len(middles))) for s, n in zip(starts, step, strict=True))
        highest = [np.fmax.reduce(np.take(values, pixel, axis), axis) for pixel in pixels_of]
        picked = np.stack(highest, axis)
    else:
        picked = np.take(values, nearest, axis)
    outside = (middle < first) | (middle > last)
    return np.where(outside[:, None] if axis == 0 else outside, np.nan, picked)


def _contours(mark: Image, frame: Frame) -> str:
    if not mark.contours:
        return ""
    from contourpy import contour_generator

    lines_of = contour_generator(numbers(mark.x), numbers(mark.y), numbers(mark.values)).lines
    parts = []
    for level in mark.contours:
        for line in map(numbers, lines_of(level)):
            points = frame.points(line[:, 0], line[:, 1])
            parts.append(f'<path d="{path(points)}" fill="none" stroke="#fff" stroke-width=".9"/>')
            if len(line) > 12:
                x, y = points[len(points) // 2]
                parts.append(words(x, y, f"{level:g}", "middle", fill="#fff", font_size="10"))
    return "".join(parts)


def colour_bar(mark: Image, box: Box) -> str:
    """Return the scale of the colours at the right of the axes."""
    low, high = mark.ends
    x, width = box.x + box.width + 9.0, 11.0
    count = 32
    each = box.height / count
    cells = "".join(
        f'<path d="{rectangle(Box(x, box.y + row * each, width, each + 0.4))}" '
        f'fill="#{PALETTE[3 * index : 3 * index + 3].hex()}"/>'
        for row in range(count)
        for index in [round(254 * (1.0 - (row + 0.5) / count))]
    )
    ticks = "".join(
        words(x + width + 4.0, box.y + box.height * (high - value) / (high - low) + 4.0, word)
        for value, word in round_ticks(low, high, most=5)
    )
    name = upright_words(x + width + 38.0, box.y + 0.5 * box.height, mark.label)
    return cells + ticks + name
