"""Points of a room where pressure is read off its series: rows and columns of a lattice."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.errors import ParameterError
from ..arrays import Array, IndexArray
from .cutting import AirBox
from .piece import Piece, piece

_EDGE_M = 1e-9


@dataclass(frozen=True)
class Lattice:
    """All points (x, y, z) of three lines, m, in the room's coordinates."""

    x: Array
    y: Array
    z: Array

    @property
    def lines(self) -> tuple[Array, Array, Array]:
        """Along each axis."""
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
    """Which box of air holds a point, the first of those that share it.

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
    first_place: int = 0,
) -> list[Piece]:
    """Pressure (-1) and derivatives by axis at a lattice, by box of air.

    Places are those of a flat array (quantity, x, y, z) that begins at `first_place`.

    Raises
    ------
    ParameterError
        A point lies in a block or outside the room.
    """
    shape = (len(quantities), *lattice.shape)
    result_rows: IndexArray = first_place + np.arange(int(np.prod(shape))).reshape(shape)
    left, pieces = np.ones(lattice.shape, dtype=bool), []
    for number, box in enumerate(boxes):
        at = [
            np.flatnonzero((line >= low - _EDGE_M) & (line <= high + _EDGE_M))
            for line, low, high in zip(lattice.lines, box.lower, box.upper, strict=True)
        ]
        if left[np.ix_(*at)].any():
            left[np.ix_(*at)] = False
            lines = [line[i] for line, i in zip(lattice.lines, at, strict=True)]
            pieces += [
                piece(number, box, lines, time_step_s, quantity, of[np.ix_(*at)].ravel())
                for quantity, of in zip(quantities, result_rows, strict=True)
            ]
    if left.any():
        first = np.argwhere(left)[0]
        holding([], np.array([line[i] for line, i in zip(lattice.lines, first, strict=True)]))
    return pieces
