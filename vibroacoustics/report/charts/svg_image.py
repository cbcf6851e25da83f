"""Values over a plane in SVG: colours, contours, and the scale of the colours."""

import base64
import io

import numpy as np

from ...base.arrays import Array, IndexArray
from .colours import PALETTE, numbers
from .frame import Frame, edges_of
from .layout import Box, Scale, round_ticks
from .marks import Image
from .svg_parts import path, rectangle, words


def image(mark: Image, frame: Frame) -> str:
    """Return the colours and contours of an image within its axes."""
    from PIL import Image as Raster

    low, high = mark.ends
    grid = _resampled(mark, frame)
    share = np.clip((grid - low) / (high - low), 0.0, 1.0)
    index = np.where(np.isfinite(grid), np.round(np.nan_to_num(share) * 254.0), 255.0)
    raster = Raster.fromarray(index.astype(np.uint8), "P")
    raster.putpalette(PALETTE)
    content = io.BytesIO()
    raster.save(content, "png", compress_level=6)
    box = frame.box
    picture = _png(box, content.getvalue())
    return picture + _contours(mark, frame)


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
        pixel_values = [
            np.fmax.reduce(np.take(values, range(s, min(s + n, len(middles))), axis), axis)
            for s, n in zip(starts, step, strict=True)
        ]
        picked = np.stack(pixel_values, axis)
    else:
        picked = np.take(values, nearest, axis)
    outside = (middle < first) | (middle > last)
    return np.where(outside[:, None] if axis == 0 else outside, np.nan, picked)


def _png(box: Box, content: bytes) -> str:
    address = base64.b64encode(content).decode()
    return (
        f'<image x="{box.x:.1f}" y="{box.y:.1f}" width="{box.width:.1f}" '
        f'height="{box.height:.1f}" preserveAspectRatio="none" '
        f'href="data:image/png;base64,{address}"/>'
    )


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
    left, width = box.x + box.width + 9.0, 11.0
    count = 32
    each = box.height / count
    cells = "".join(
        f'<path d="{rectangle(Box(left, box.y + row * each, width, each + 0.4))}" '
        f'fill="#{PALETTE[3 * index : 3 * index + 3].hex()}"/>'
        for row in range(count)
        for index in [round(254 * (1.0 - (row + 0.5) / count))]
    )
    ticks = "".join(
        words(
            left + width + 4.0,
            box.y + box.height * (1.0 - (value - low) / (high - low)) + 4.0,
            word,
        )
        for value, word in round_ticks(low, high, most=5)
    )
    position = (left + width + 38.0, box.y + 0.5 * box.height)
    turn = f"rotate(-90 {position[0]:.1f} {position[1]:.1f})"
    return cells + ticks + words(*position, mark.label, "middle", transform=turn)
