"""Points of one box of air: what leads from series and fluxes to pressure and its derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, IndexArray
from .cutting import AirBox
from .series import cosines, left_out, series_mass_m, slopes

_NEGLIGIBLE: Final = 0.01
"""Share of what a series lacks at its end: sides that matter less to the points are left out."""


@dataclass(frozen=True)
class Piece:
    """A quantity at rows and columns of points in a box.

    Series alone would be wrong near seams and walls by the pressure that drives the flux through
    them: the terms that are left out are added from the fluxes. That is also how a source acts, so
    that source and point may be exchanged.
    """

    box: int
    bases: tuple[Array, Array, Array]
    """From terms to points along each axis, (point, term)."""
    near: tuple[tuple[int, int, Array], ...]
    """Sides that matter: axis, end, and what the series lacks along the axis, (point,)."""
    result_rows: IndexArray
    """Of the points in what is read, (point,)."""


def piece(
    number: int,
    box: AirBox,
    lines: Sequence[Array],
    time_step_s: float,
    quantity: int,
    result_rows: IndexArray,
) -> Piece:
    """Pressure (-1) or its derivative along an axis at points of a box."""
    of = [
        (line - low, float(size), count)
        for line, low, size, count in zip(lines, box.lower, box.size, box.nodes, strict=True)
    ]
    x, y, z = (slopes(*one) if axis == quantity else cosines(*one) for axis, one in enumerate(of))
    near = []
    reach = SPEED_OF_SOUND_M_PER_S * time_step_s
    for axis, (line, length, nodes) in enumerate(of):
        least = _NEGLIGIBLE * series_mass_m(length, nodes, time_step_s)
        for end in (0, 1):
            points = length - line if end else line
            values, slope = left_out(points, length, nodes, time_step_s)
            if np.abs(values).max() > least:
                along = (-slope if end else slope) if axis == quantity else values
                near.append((axis, end, along / reach))
    return Piece(number, (x, y, z), tuple(near), result_rows)
