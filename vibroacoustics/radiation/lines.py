"""Parts of straight lines within a body: the basis of the cut cells."""

from typing import Any, Final

import numba
import numpy as np

from ..base.errors import ParameterError
from .arrays import Array, IndexArray
from .bodies import Body

_OFF_EDGE: Final = np.array([3.3e-7, 7.1e-7])
"""Lines are moved by these shares of the cell, so that none meets an edge or a corner."""


def fluid_on_lines(
    body: Body,
    axis: int,
    across: tuple[Array, Array],
    lines_per_cell: tuple[int, int],
    edges: Array,
) -> Array:
    """Mean fluid share of cells over parallel lines, (first across, second across, cell along).

    The lines run along `axis`, through the points of a grid whose coordinates `across` belong to
    the two axes that follow in cyclic order; `lines_per_cell` neighbours make one cell. Along the
    lines cells end at `edges`. The share is exact along each line: a line is inside where more
    surfaces were entered than left.

    Raises
    ------
    ParameterError
        A line enters the body more often than it leaves it: the surface is open.
    """
    order = [axis, (axis + 1) % 3, (axis + 2) % 3]
    triangles = np.ascontiguousarray(body.triangles[:, :, order])
    first_across, second_across = (
        coordinate + offset * (edges[1] - edges[0])
        for coordinate, offset in zip(across, _OFF_EDGE, strict=True)
    )
    starts, along, sense = _crossings(triangles, first_across, second_across)
    position = np.interp(along, edges, np.arange(float(edges.size)))
    solid = np.zeros(
        (across[0].size // lines_per_cell[0], across[1].size // lines_per_cell[1], edges.size - 1)
    )
    if _fill(solid, starts, position, sense, across[1].size, lines_per_cell):
        raise ParameterError("the surface of the body is not closed")
    return 1.0 - solid / (lines_per_cell[0] * lines_per_cell[1])


def _crossings(triangles: Array, first: Array, second: Array) -> tuple[IndexArray, Array, Array]:
    """Crossings sorted by line, then along it: line start (line + 1,), coordinate, sense."""
    number = _find(triangles, first, second, np.empty(0, np.int64), np.empty(0), np.empty(0))
    line, along, sense = np.empty(number, np.int64), np.empty(number), np.empty(number)
    _find(triangles, first, second, line, along, sense)
    order = np.lexsort((along, line))
    starts = np.searchsorted(line[order], np.arange(first.size * second.size + 1))
    return starts, along[order], sense[order]


@numba.njit(cache=True, nogil=True)
def _find(
    triangles: Any, first: Any, second: Any, line: Any, along: Any, sense: Any
) -> int:  # pragma: no cover
    """Write every crossing of a line with a triangle, if there is room; return their number."""
    count = 0
    for triangle in triangles:
        i_start = np.searchsorted(first, triangle[:, 1].min())
        i_stop = np.searchsorted(first, triangle[:, 1].max())
        j_start = np.searchsorted(second, triangle[:, 2].min())
        j_stop = np.searchsorted(second, triangle[:, 2].max())
        if i_start == i_stop or j_start == j_stop:
            continue
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangle[0], triangle[1], triangle[2]
        twice = (by - ay) * (cz - az) - (bz - az) * (cy - ay)
        if twice == 0.0:
            continue
        for i in range(i_start, i_stop):
            y = first[i]
            for j in range(j_start, j_stop):
                z = second[j]
                # Every edge is evaluated from its smaller corner, so that both of its triangles
                # see the same number.
                ea = _edge(by, bz, cy, cz, y, z)
                eb = _edge(cy, cz, ay, az, y, z)
                ec = _edge(ay, az, by, bz, y, z)
                if (ea > 0 and eb > 0 and ec > 0) or (ea < 0 and eb < 0 and ec < 0):
                    if line.size:
                        line[count] = i * second.size + j
                        along[count] = (ea * ax + eb * bx + ec * cx) / (ea + eb + ec)
                        # A normal along the line: the line leaves the body.
                        sense[count] = -1.0 if twice > 0.0 else 1.0
                    count += 1
    return count


@numba.njit(cache=True, nogil=True, inline="always")
def _edge(ay: float, az: float, by: float, bz: float, y: float, z: float) -> float:
    """Twice the signed area of the triangle (a, b, point)."""  # pragma: no cover
    if (ay, az) > (by, bz):
        return -((ay - by) * (z - bz) - (az - bz) * (y - by))
    return (by - ay) * (z - az) - (bz - az) * (y - ay)


@numba.njit(cache=True, nogil=True)
def _fill(
    solid: Any, starts: Any, position: Any, sense: Any, columns: int, lines_per_cell: Any
) -> bool:  # pragma: no cover
    """Add the solid share of each cell along each line; return whether a line ends inside.

    Positions are in cells.
    """
    ends_inside = False
    for line in range(starts.size - 1):
        cells = solid[(line // columns) // lines_per_cell[0], (line % columns) // lines_per_cell[1]]
        winding, entry = 0.0, 0.0
        for crossing in range(starts[line], starts[line + 1]):
            before = winding
            winding += sense[crossing]
            if winding > 0.0 and before <= 0.0:
                entry = position[crossing]
            elif winding <= 0.0 and before > 0.0:
                low, high = entry, position[crossing]
                for cell in range(int(low), int(np.ceil(high))):
                    cells[cell] += min(high, cell + 1.0) - max(low, float(cell))
        ends_inside = ends_inside or winding != 0.0
    return ends_inside
