"""Deflection of the shell at the loudest line: a ring and a side view, moving."""

from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array, ComplexArray
from ..charts.layout import COLOURS
from ..charts.svg import Picture
from ..charts.svg_parts import opening, path, words

FRAMES: Final = 16
"""Shapes of a cycle, between which the page moves."""
_WIDTH: Final = 442.0
_ROW: Final = 250.0
_SIZE: Final = 190.0
"""Size of a view, pixels."""
_SHOWN: Final = 0.12
"""Largest deflection on paper, as a share of the height of the shell."""
_STYLE: Final = (
    "<style>.still{display:none}@media(prefers-reduced-motion:reduce)"
    "{.moving{display:none}.still{display:inline}}</style>"
)


class Shape(NamedTuple):
    """A line of the shell with its displacement, complex peak; right and up, shape (point, 2)."""

    points_m: Array
    displacement_m: ComplexArray
    title: str


def deflection_picture(results: xr.Dataset) -> Picture:
    """Draw the deflection at the loudest line of each shown option; it moves over one cycle."""
    shown = [results.sel(shown_option=option) for option in results["shown_option"].values]
    parts = [part for row, case in enumerate(shown) for part in _row(case, 8.0 + row * _ROW)]
    height = 8.0 + _ROW * len(shown)
    alt = "Deflection of the shell at the loudest line: a ring from above, and from the side."
    head = opening(_WIDTH, height, alt) + _STYLE
    largest = "; ".join(f"{case['shown_option'].item()} {_largest(case)}" for case in shown)
    return Picture(
        "deflection",
        alt,
        "Deflection of the shell by all modelled sources at the line with the highest A-weighted "
        f"level, {float(results['shown_speed']):g} rpm, of one weighted sample. Largest "
        f"displacement, peak: {largest}. Grey: at rest. Displacements are enlarged.",
        "\n".join([head, *parts, "</svg>\n"]).encode(),
        "svg",
    )


def shapes(case: xr.Dataset) -> tuple[Shape, Shape]:
    """Return the ring that moves most, and the meridian through its largest radial displacement."""
    angle, radius = case["station_angle"].values, case["station_radius"].values
    field = case["deflection"].transpose("station", "station_angle", "axis").values
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    radial = np.abs((field[..., :2] * outward).sum(axis=-1))
    radial *= (radius >= 0.5 * radius.max())[:, None]
    station, column = np.unravel_index(int(radial.argmax()), radial.shape)
    height = case["station_height"].values
    ring = Shape(
        radius[station] * outward,
        field[station, :, :2],
        f"ring {1e3 * (height[station] - height.min()):.0f} mm above the bottom",
    )
    opposite = (column + angle.size // 2) % angle.size
    near, far = (
        np.stack(
            [sign * radius, height, field[:, n, :2] @ outward[column], field[:, n, 2]], axis=-1
        )
        for n, sign in ((column, 1.0), (opposite, -1.0))
    )
    around = np.concatenate([near, far[::-1]])
    side = Shape(
        around[:, :2].real,
        around[:, 2:],
        f"side, {np.rad2deg(angle[column]):.0f}° from x to the right",
    )
    return ring, side


def cycle(displacement_m: ComplexArray, of_all: ComplexArray) -> Array:
    """Return displacements over a cycle, shape (frame, point, 2).

    The first is that at which `of_all`, complex peaks, are largest.
    """
    start = -0.5 * np.angle(np.sum(of_all**2))
    phase = start + 2.0 * np.pi * np.arange(FRAMES) / FRAMES
    return np.asarray((np.exp(1j * phase)[:, None, None] * displacement_m).real)


def _row(case: xr.Dataset, top: float) -> Iterator[str]:
    """Title and both views of an option."""
    line, frequency = case["deflection_line"].item(), float(case["deflection_frequency"])
    yield words(8.0, top + 12.0, f"{case['shown_option'].item()}: {line}, {frequency:.0f} Hz")
    views = shapes(case)
    tall = float(np.ptp(views[1].points_m[:, 1]))
    every = np.concatenate([view.displacement_m.ravel() for view in views])
    enlarged = _SHOWN * tall / max(float(np.abs(every).max()), 1e-30)
    for column, view in enumerate(views):
        middle = np.array([_WIDTH * (0.25 + 0.5 * column), top + 24.0 + 0.5 * _SIZE])
        centre = 0.5 * (view.points_m.min(axis=0) + view.points_m.max(axis=0))
        outlines = view.points_m - centre + enlarged * cycle(view.displacement_m, every)
        size = float(np.ptp(view.points_m, axis=0).max())
        flip = _SIZE / (1.3 * size + 0.1 * tall) * np.array([1.0, -1.0])
        looks = 'fill="none" stroke="#9aa3ab" stroke-dasharray="4 3"'
        yield f'<path d="{path(middle + flip * (view.points_m - centre))}Z" {looks}/>'
        yield _moving([middle + flip * points for points in outlines])
        yield words(middle[0], top + 26.0 + _SIZE + 12.0, view.title, "middle")


def _moving(frames: list[Array]) -> str:
    """An outline that moves, and the same at its first shape where nothing may move."""
    looks = f'fill="{COLOURS[3]}" fill-opacity=".12" stroke="{COLOURS[3]}" stroke-width="2"'
    outlines = [f"{path(points)}Z" for points in frames]
    values = ";".join([*outlines, outlines[0]])
    motion = f'<animate attributeName="d" dur="2s" repeatCount="indefinite" values="{values}"/>'
    still = f'<path class="still" d="{outlines[0]}" {looks}/>'
    return f'<path class="moving" d="{outlines[0]}" {looks}>{motion}</path>{still}'


def _largest(case: xr.Dataset) -> str:
    size: Any = np.sqrt((np.abs(case["deflection"].values) ** 2).sum(axis=-1)).max()
    digits, unit = (1e9, "nm") if size < 1e-6 else (1e6, "µm")
    return f"{rounding.significant(digits * float(size))} {unit}"
