"""Parts of a drawing in SVG: text without fonts or styles from elsewhere."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from ...base.arrays import Array
from ...base.visible import escape

INK: Final = "#1b1f24"
SOFT: Final = "#57606a"
HEAD_LENGTH: Final = 7.0


def drawing(width: float, height: float, parts: Sequence[str], title: str) -> bytes:
    """The file of a drawing; sizes are those of its user unit, about a pixel on a phone."""
    first = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}" font-family="system-ui,Helvetica,sans-serif" '
        f'font-size="12" fill="{INK}">'
    )
    title = f"<title>{escape(title)}</title>"
    return "\n".join([first, title, *parts, "</svg>\n"]).encode()


def path(points: Array, closed: bool = False, **looks: Any) -> str:
    """A line through points, shape (point, 2)."""
    coordinates = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path d="M{coordinates}{"Z" if closed else ""}"{_looks(looks)}/>'


def words(position: Sequence[float], text: str, anchor: str = "start", **looks: Any) -> str:
    """Text that starts, ends or has its middle at a point, with white around it."""
    looks = {"paint_order": "stroke", "stroke": "#fff", "stroke_width": 3} | looks
    where = f'x="{position[0]:.1f}" y="{position[1]:.1f}" text-anchor="{anchor}"'
    return f"<text {where}{_looks(looks)}>{escape(text)}</text>"


def disc(position: Sequence[float] | Array, radius: float, **looks: Any) -> str:
    """A circle about a point."""
    return f'<circle cx="{position[0]:.1f}" cy="{position[1]:.1f}" r="{radius:g}"{_looks(looks)}/>'


def arrow(tail: Array, tip: Array, colour: str) -> str:
    """A line with a head at its tip; nothing where it is too short for one."""
    along = tip - tail
    length = float(np.hypot(*along))
    if length < 1.0:
        return ""
    head = min(HEAD_LENGTH, 0.6 * length)
    along = along / length
    across = np.array([-along[1], along[0]])
    foot = tip - head * along
    wings = np.array([tip, foot + 0.45 * head * across, foot - 0.45 * head * across])
    line = path(np.array([tail, foot]), stroke=colour, stroke_width=2)
    return line + path(wings, True, fill=colour)


def _looks(looks: dict[str, Any]) -> str:
    return "".join(f' {name.replace("_", "-")}="{value}"' for name, value in looks.items())
