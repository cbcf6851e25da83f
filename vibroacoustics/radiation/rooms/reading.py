"""Compiled reading of pressures and derivatives off series and fluxes."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import Array, IndexArray
from .air import Air
from .box_step import kernel
from .lattice import Piece
from .layout import Layout


class Readings:
    """All pieces of all lattices, as flat arrays.

    Each piece has a row: first term, terms and points along each axis, first entry of its three
    matrices, first row of the result, first and last of its sides. Each side has one: axis, first
    entry of its flux, first entry of what the series lacks.
    """

    def __init__(self, plan: Layout, pieces: Sequence[Piece]) -> None:
        rows: list[list[int]] = []
        sides: list[list[int]] = []
        numbers: list[Array] = [np.zeros(0)]
        result_rows: list[IndexArray] = [np.zeros(0, dtype=np.intp)]
        entry = row = 0
        for piece in pieces:
            matrices = []
            for basis in piece.bases:
                matrices.append(entry)
                numbers.append(basis.ravel())
                entry += basis.size
            first = len(sides)
            for axis, end, along in piece.near:
                sides.append([axis, int(plan.sides[piece.box, axis, end]), entry])
                numbers.append(along)
                entry += along.size
            points, terms = zip(*(basis.shape for basis in piece.bases), strict=True)
            start = int(plan.terms[piece.box])
            rows.append([start, *terms, *points, *matrices, row, first, len(sides)])
            result_rows.append(piece.result_rows)
            row += piece.result_rows.size
        self._pieces = (
            np.array(rows, dtype=np.intp).reshape(-1, 13),
            np.array(sides, dtype=np.intp).reshape(-1, 3),
            np.concatenate(numbers),
            np.concatenate(result_rows),
        )

    def read(self, air: Air, result: Array) -> None:
        """Values of all pieces, into their places (column,)."""
        read_pieces(air.terms, air.flux, *self._pieces, result)


@kernel
def read_pieces(
    terms: Any, flux: Any, pieces: Any, sides: Any, matrices: Any, result_rows: Any, result: Any
) -> None:  # pragma: no cover
    """Values of all pieces, into their places of the result."""
    for piece in pieces:
        n, p = piece[1:4], piece[4:7]
        values = _of_series(terms[piece[0] : piece[0] + n[0] * n[1] * n[2]], piece, matrices)
        for number in range(piece[11], piece[12]):
            axis, first, lacking = sides[number, 0], sides[number, 1], sides[number, 2]
            first_axis, other = (1 if axis == 0 else 0), (1 if axis == 2 else 2)
            plane = flux[first : first + n[first_axis] * n[other]].reshape(n[first_axis], n[other])
            first_matrix, right = (
                _matrix(matrices, piece, first_axis),
                _matrix(matrices, piece, other),
            )
            flux_at_points = np.dot(np.dot(first_matrix, plane), right.T)
            for a in range(p[axis]):
                share = matrices[lacking + a]
                if axis == 0:
                    values[a] -= share * flux_at_points
                elif axis == 1:
                    values[:, a] -= share * flux_at_points
                else:
                    values[:, :, a] -= share * flux_at_points
        flat = values.ravel()
        first = piece[10]
        for point in range(flat.size):
            result[result_rows[first + point]] = flat[point]


@kernel
def _matrix(matrices: Any, piece: Any, axis: int) -> Any:  # pragma: no cover
    """Matrix from terms to points along an axis, (point, term)."""
    first, count, points = piece[7 + axis], piece[1 + axis], piece[4 + axis]
    return matrices[first : first + points * count].reshape(points, count)


@kernel
def _of_series(terms: Any, piece: Any, matrices: Any) -> Any:  # pragma: no cover
    """Values (x, y, z) of a series; the axis with the fewest points is summed over first."""
    n0, n1, n2 = piece[1], piece[2], piece[3]
    p0, p1, p2 = piece[4], piece[5], piece[6]
    x, y = _matrix(matrices, piece, 0), _matrix(matrices, piece, 1)
    z = _matrix(matrices, piece, 2)
    values = np.empty((p0, p1, p2))
    if p0 <= p1 and p0 <= p2:
        planes = np.dot(x, terms.reshape(n0, n1 * n2))
        for a in range(p0):
            values[a] = np.dot(np.dot(y, planes[a].reshape(n1, n2)), z.T)
    elif p1 <= p2:
        rows = np.empty((p1, n0, n2))
        cube = terms.reshape(n0, n1, n2)
        for i in range(n0):
            rows[:, i] = np.dot(y, cube[i])
        for b in range(p1):
            values[:, b] = np.dot(np.dot(x, rows[b]), z.T)
    else:
        columns = np.dot(z, terms.reshape(n0 * n1, n2).T)
        for c in range(p2):
            values[:, :, c] = np.dot(np.dot(x, columns[c].reshape(n0, n1)), y.T)
    return values
