"""Re-entrant edges of furniture: less air at the interfaces of boxes beside them."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..arrays import Array, IndexArray
from .cutting import AirBox, Face

EDGE_RATIO: Final = 0.163
"""Excess air of a node beside a re-entrant edge over its width, by `interface_air_m`."""
_LEAST_RATIO: Final = 0.3
"""Least share of the air of a node that is kept."""
_ASIDE_M: Final = 1e-5


def interface_air_m(
    boxes: Sequence[AirBox], face: Face, nodes: Sequence[int], air_m: float
) -> Array:
    """Return the length of air at each node of an interface, shape (node, node), m.

    It is less beside re-entrant edges.

    Around an edge of 270 degrees of air the flux grows as r^(-1/3) (P. Grisvard, Elliptic Problems
    in Nonsmooth Domains, 1985, section 4.4). A node beside it passes it as if it were even over its
    width, with too much kinetic energy: frequencies fall by the spacing's power of 4/3. Too much is
    a length of air in proportion to the width. `EDGE_RATIO` is the one with which the lowest
    frequency of M. Dauge's L-shaped region is exact; square nodes of 1/4, 1/8 and 1/12 of its short
    edges need 0.162 to 0.166, at any time step.

    Parameters
    ----------
    boxes : boxes of the air
    face : interface between two of them
    nodes : its nodes along both axes
    air_m : length of air at a node away from edges, m
    """
    across = np.delete(np.arange(3), face.ends[0].axis)
    lengths = np.full(tuple(nodes), air_m)
    widths = (face.upper - face.lower) / nodes
    for row in (0, 1):
        other = 1 - row
        along = face.lower[other] + widths[other] * (np.arange(nodes[other]) + 0.5)
        for end, border in ((0, face.lower[row]), (-1, face.upper[row])):
            edge = np.zeros((along.size, 3))
            edge[:, face.ends[0].axis] = boxes[face.ends[0].box].upper[face.ends[0].axis]
            edge[:, across[row]], edge[:, across[other]] = border, along
            turns = _turns(boxes, edge, (face.ends[0].axis, int(across[row])))
            beside = np.moveaxis(lengths, row, 0)[end]  # a view
            beside -= EDGE_RATIO * widths[row] * turns
    return np.asarray(np.maximum(lengths, _LEAST_RATIO * air_m))


def _turns(boxes: Sequence[AirBox], edge: Array, axes: tuple[int, int]) -> Array:
    """Whether two boxes fill three of the four quadrants around points of an edge, (point,).

    Two interfaces of three boxes share the flux; their excess is small (0.02 to 0.04 widths).
    """
    quadrants = []
    for first in (-_ASIDE_M, _ASIDE_M):
        for second in (-_ASIDE_M, _ASIDE_M):
            points = edge.copy()
            points[:, axes[0]] += first
            points[:, axes[1]] += second
            quadrants.append(_boxes_of(boxes, points))
    held = np.sort(quadrants, axis=0)
    distinct = 1 + np.count_nonzero(np.diff(held[1:], axis=0), axis=0)
    return np.asarray((held[0] < 0) & (held[1] >= 0) & (distinct == 2))


def _boxes_of(boxes: Sequence[AirBox], points: Array) -> IndexArray:
    """Number of the box that holds each point, -1 in a solid, (point,)."""
    held = np.full(len(points), -1, dtype=np.intp)
    for number, box in enumerate(boxes):
        held[np.all((points > box.lower) & (points < box.upper), axis=1)] = number
    return held
