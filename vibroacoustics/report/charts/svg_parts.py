"""Parts of a drawing in SVG: words, paths, markers, heads of arrows."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.visible import escape
from .layout import Box

INK: Final = "#1b1f24"
_FAR: Final = 1e6
"""Points further away, in pixels, break a line."""
SHAPES: Final = {
    "s": "M-1-1H1V1H-1Z",
    "^": "M0-1.2L1.15.9H-1.15Z",
    "v": "M0 1.2L1.15-.9H-1.15Z",
    "D": "M0-1.3L1.3 0 0 1.3-1.3 0Z",
    "P": "M-.4-1.2H.4V-.4H1.2V.4H.4V1.2H-.4V.4H-1.2V-.4H-.4Z",
    "x": "M-1-1L1 1M-1 1L1-1",
    "X": "M-1-1L1 1M-1 1L1-1",
    "_": "M-1.4 0H1.4",
}
_STROKED: Final = frozenset("xX_")


def opening(width: float, height: float, title: str) -> str:
    """Return the beginning of a drawing; its sizes are pixels."""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:.0f}" '
        f'width="{width:g}" height="{height:.0f}" '
        f'font-family="system-ui,Helvetica,Arial,sans-serif" '
        f'font-size="12" fill="{INK}"><title>{escape(title)}</title>'
    )


def words(x: float, y: float, text: str, anchor: str = "start", **looks: str) -> str:
    """Text of one line or several."""
    if not text:
        return ""
    more = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in looks.items())
    more += f' text-anchor="{anchor}"' if anchor != "start" else ""
    first, *others = text.split("\n")
    spans = "".join(f'<tspan x="{x:.1f}" dy="14">{escape(line)}</tspan>' for line in others)
    return f'<text x="{x:.1f}" y="{y:.1f}"{more}>{escape(first)}{spans}</text>'


def upright_words(x: float, y: float, text: str) -> str:
    """Text that runs upwards through a point in its middle."""
    return words(x, y, text, "middle", transform=f"rotate(-90 {x:.1f} {y:.1f})")


def rectangle(box: Box) -> str:
    """Return the path of a rectangle."""
    return f"M{box.x:.1f} {box.y:.1f}h{box.width:.1f}v{box.height:.1f}h{-box.width:.1f}Z"


def path(points: Array) -> str:
    """A line through points, shape (n, 2), which breaks where one is not finite."""
    shape, begin = [], True
    for x, y in points.tolist():
        if not (abs(x) < _FAR and abs(y) < _FAR):
            begin = True
            continue
        shape.append(f"{'M' if begin else 'L'}{x:.1f} {y:.1f}")
        begin = False
    return "".join(shape)


def pairs(first: Array, last: Array) -> str:
    """Return a path of straight lines between points, shape (n, 2) each."""
    finite = np.isfinite(first).all(axis=1) & np.isfinite(last).all(axis=1)
    ends = zip(first[finite].tolist(), last[finite].tolist(), strict=True)
    return "".join(f"M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" for (a, b), (c, d) in ends)


def markers(points: Array, shape: str, size: float, colour: str, filled: bool) -> str:
    """Return markers at points, shape (n, 2), that are finite."""
    finite = points[np.isfinite(points).all(axis=1)].tolist()
    looks = f'fill="{colour}"' if filled else f'fill="#fff" fill-opacity="0" stroke="{colour}"'
    if shape in _STROKED:
        looks = f'stroke="{colour}" stroke-width="{1.6 / size:.2g}"'
    elif not filled:
        looks += f' stroke-width="{1.3 if shape in "o." else 1.3 / size:.2g}"'
    if shape in "o." and filled:
        dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in finite)
        looks = f'stroke="{colour}" stroke-width="{2.0 * size:.3g}" stroke-linecap="round"'
        return f'<path d="{dots}" {looks}/>'
    if shape in "o.":
        return "".join(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size:.3g}" {looks}/>' for x, y in finite
        )
    outline = SHAPES[shape]
    return "".join(
        f'<path d="{outline}" transform="translate({x:.1f} {y:.1f})scale({size:.3g})" {looks}/>'
        for x, y in finite
    )


def head(tail: Array, tip: Array, colour: str) -> str:
    """The head of an arrow; nothing where it is too short for one."""
    along = tip - tail
    length = float(np.hypot(*along))
    if not length >= 1.0:
        return ""
    head = min(8.0, 0.6 * length)
    along = along / length
    across, foot = np.array([-along[1], along[0]]), tip - head * along
    wings = np.array([tip + along, foot + 0.45 * head * across, foot - 0.45 * head * across])
    return f'<path d="{path(wings)}Z" fill="{colour}"/>'


def thinned(points: Array) -> Array:
    """Points with at most the highest and the lowest in each pixel, where x rises."""
    x = points[:, 0]
    if len(points) < 1500 or not np.all(np.diff(x) >= 0.0) or not np.isfinite(points).all():
        return points
    column = np.floor(x).astype(int)
    starts = np.flatnonzero(np.diff(column, prepend=column[0] - 1))
    y = points[:, 1]
    ends = np.stack([np.minimum.reduceat(y, starts), np.maximum.reduceat(y, starts)], axis=1)
    return np.stack([np.repeat(x[starts], 2), ends.ravel()], axis=-1)
