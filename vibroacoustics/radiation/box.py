"""The closed box on which the machine side and the room side meet."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from .arrays import Array, ComplexArray


@dataclass(frozen=True)
class Box:
    """Pairs of points, half a cell inside and half a cell outside each cell face of a box.

    Values on both layers stand for value and normal gradient. A side on a hard wall is omitted:
    pressure and Green's function both have zero normal derivative there, so that it would
    contribute nothing. Where only the pressure has, as over ground on the way to the microphones,
    the side on the floor is there; its outer points lie below it, where the pressure is mirrored.
    """

    lower: Array
    upper: Array
    inner: Array
    """Points inside, (pair, 3), m."""
    outer: Array
    """Points outside, (pair, 3), m."""
    weights: Array
    """Area of the face over the distance of its two points, (pair,), m."""


@dataclass(frozen=True)
class BoxField:
    """A field on a box at some frequencies: sound pressure, or a Green's function."""

    inner: ComplexArray
    """(frequency, pair)."""
    outer: ComplexArray
    """(frequency, pair)."""


Side = tuple[int, int]
"""Axis, and -1 for its lower or 1 for its upper side."""
FLOOR: Final[Side] = (2, -1)


def open_sides(on_walls: Collection[Side], with_floor: bool = False) -> list[Side]:
    """Sides of a box that do not lie on a wall; that on the floor too where it is asked for."""
    sides = [(axis, sign) for axis in range(3) for sign in (-1, 1)]
    return [side for side in sides if side not in on_walls or (with_floor and side == FLOOR)]


def closed_box(
    edges: Sequence[Array],
    start: Sequence[int],
    stop: Sequence[int],
    on_walls: Collection[Side],
    with_floor: bool = False,
) -> Box:
    """The box of the cells from `start` to `stop` of a grid, without its sides on walls.

    Parameters
    ----------
    edges : edges of the grid
    start, stop : cells
    on_walls : sides that lie on walls
    with_floor : whether that on the floor is there nevertheless
    """
    middles = [(line[1:] + line[:-1]) / 2.0 for line in edges]
    inner, outer, weights = [], [], []
    for axis, sign in open_sides(on_walls, with_floor):
        inner_cell = stop[axis] - 1 if sign > 0 else start[axis]
        across = middles[axis][[inner_cell, inner_cell + sign]]
        if (axis, sign) in on_walls:
            across[1] = 2.0 * edges[axis][inner_cell] - across[0]
        layers = []
        for coordinate in across:
            lines = [middle[a:b] for middle, a, b in zip(middles, start, stop, strict=True)]
            lines[axis] = np.array([coordinate])
            layers.append(np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3))
        widths = [np.diff(line)[a:b] for line, a, b in zip(edges, start, stop, strict=True)]
        widths[axis] = 1.0 / np.abs(np.diff(across))
        inner.append(layers[0])
        outer.append(layers[1])
        weights.append(np.einsum("i,j,k->ijk", *widths).ravel())
    lower = np.array([line[a] for line, a in zip(edges, start, strict=True)])
    upper = np.array([line[b] for line, b in zip(edges, stop, strict=True)])
    return Box(lower, upper, *map(np.concatenate, (inner, outer, weights)))
