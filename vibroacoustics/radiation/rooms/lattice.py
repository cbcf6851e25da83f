"""Points of a room where pressure is read off its series: rows and columns of a lattice."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.errors import ParameterError
from ..arrays import Array
from .air import Air
from .cutting import AirBox
from .piece import Piece

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


class Reader:
    """Reads pressure (-1) and derivatives by axis at a lattice."""

    def __init__(
        self,
        boxes: Sequence[AirBox],
        lattice: Lattice,
        time_step_s: float,
        quantities: Sequence[int],
    ) -> None:
        self._quantities = tuple(quantities)
        self.shape = (len(quantities), *lattice.shape)
        """Quantities; points along each axis."""
        left = np.ones(lattice.shape, dtype=bool)
        self._pieces = []
        for number, box in enumerate(boxes):
            at = [
                np.flatnonzero((line >= low - _EDGE_M) & (line <= high + _EDGE_M))
                for line, low, high in zip(lattice.lines, box.lower, box.upper, strict=True)
            ]
            if left[np.ix_(*at)].any():
                left[np.ix_(*at)] = False
                lines = [line[i] for line, i in zip(lattice.lines, at, strict=True)]
                piece = Piece(number, box, lines, time_step_s)
                self._pieces.append((at, piece))
        if left.any():
            first = np.argwhere(left)[0]
            holding([], np.array([line[i] for line, i in zip(lattice.lines, first, strict=True)]))

    def read(self, air: Air) -> Array:
        """Its quantities, flat from (quantity, x, y, z)."""
        result = np.empty(self.shape)
        for at, piece in self._pieces:
            for number, quantity in enumerate(self._quantities):
                result[np.ix_(np.array([number]), *at)] = piece.read(air, quantity)
        return result.ravel()
