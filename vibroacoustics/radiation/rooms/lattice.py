"""Points of a room where pressure is read off its series: rows and columns of a lattice."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ...base.errors import ParameterError
from ..arrays import Array, IndexArray
from .cutting import AirBox
from .layout import cosines, left_out, series_mass_m, slopes

_EDGE_M = 1e-9
_NEGLIGIBLE: Final = 0.01
"""Share of what a series lacks at its end: sides that matter less to the points are omitted."""


@dataclass(frozen=True)
class Piece:
    """A quantity at rows and columns of points in a box.

    Series alone would be wrong near joints and walls by the pressure that drives the flux through
    them: the omitted terms are added from the fluxes. That is also how a source acts, so
    that source and point may be exchanged.
    """

    box: int
    bases: tuple[Array, Array, Array]
    """Bases from terms to points along each axis, (point, term)."""
    near: tuple[tuple[int, int, Array], ...]
    """Sides that matter: axis, end, and what the series lacks along the axis, (point,)."""
    result_rows: IndexArray
    """Rows of the points in what is read, (point,)."""


@dataclass(frozen=True)
class Lattice:
    """All points (x, y, z) of three lines, m, in the room's coordinates."""

    x: Array
    y: Array
    z: Array

    @property
    def lines(self) -> tuple[Array, Array, Array]:
        """Lines along each axis."""
        return self.x, self.y, self.z

    @property
    def shape(self) -> tuple[int, int, int]:
        """Points along each axis."""
        return self.x.size, self.y.size, self.z.size

    @classmethod
    def of_point(cls, point: Array) -> "Lattice":
        """A single point (3,)."""
        x, y, z = np.asarray(point, dtype=float).reshape(3, 1)
        return cls(x, y, z)


def holding(boxes: Sequence[AirBox], point: Array, name: str = "room") -> int:
    """Return the box of air that holds a point, the first of those that share it.

    Raises
    ------
    ParameterError
        None does: the point lies in a block or outside the room.
    """
    for number, box in enumerate(boxes):
        if np.all((point >= box.lower - _EDGE_M) & (point <= box.upper + _EDGE_M)):
            return number
    raise ParameterError(
        f"{name}: the point {np.round(point, 4).tolist()} m lies in a block or outside the room"
    )


def pieces_of(
    boxes: Sequence[AirBox],
    lattice: Lattice,
    time_step_s: float,
    quantities: Sequence[int],
    first_index: int = 0,
) -> list[Piece]:
    """Pressure (-1) and derivatives by axis at a lattice, by box of air.

    Indices are those of a flat array (quantity, x, y, z) that begins at `first_index`.
    """
    shape = (len(quantities), *lattice.shape)
    result_rows: IndexArray = first_index + np.arange(int(np.prod(shape))).reshape(shape)
    remaining, pieces = np.ones(lattice.shape, dtype=bool), []
    for number, box in enumerate(boxes):
        indices = [
            np.flatnonzero((line >= low - _EDGE_M) & (line <= high + _EDGE_M))
            for line, low, high in zip(lattice.lines, box.lower, box.upper, strict=True)
        ]
        if remaining[np.ix_(*indices)].any():
            remaining[np.ix_(*indices)] = False
            lines = [line[i] for line, i in zip(lattice.lines, indices, strict=True)]
            pieces += [
                piece(number, box, lines, time_step_s, quantity, of[np.ix_(*indices)].ravel())
                for quantity, of in zip(quantities, result_rows, strict=True)
            ]
    if remaining.any():
        first = np.argwhere(remaining)[0]
        holding([], np.array([line[i] for line, i in zip(lattice.lines, first, strict=True)]))
    return pieces


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
    x, y, z = (
        slopes(*line) if axis == quantity else cosines(*line) for axis, line in enumerate(of)
    )
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
