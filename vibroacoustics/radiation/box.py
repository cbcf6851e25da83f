"""The closed box on which the machine side and the room side meet."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from .arrays import Array, ComplexArray


@dataclass(frozen=True)
class Box:
    """Pairs of points, half a cell inside and half a cell outside each cell face of a box.

    Values on both layers stand for value and normal gradient. A side on a hard wall is left out:
    pressure and Green's function both have zero normal derivative there, so that it would
    contribute nothing.
    """

    lower: Array
    upper: Array
    spacing_m: float
    inner: Array
    """Points inside, (pair, 3), m."""
    outer: Array
    """Points outside, (pair, 3), m."""


@dataclass(frozen=True)
class BoxField:
    """A field on a box at some frequencies: sound pressure, or a Green's function."""

    inner: ComplexArray
    """(frequency, pair)."""
    outer: ComplexArray
    """(frequency, pair)."""


Side = tuple[int, int]
"""Axis, and -1 for its lower or 1 for its upper side."""


def open_sides(on_walls: Collection[Side]) -> list[Side]:
    """Sides of a box that do not lie on a wall."""
    sides = [(axis, sign) for axis in range(3) for sign in (-1, 1)]
    return [side for side in sides if side not in on_walls]


def closed_box(lower: Array, upper: Array, spacing_m: float, on_walls: Collection[Side]) -> Box:
    """All sides of a box whose edges are whole numbers of the spacing."""
    inner, outer = [], []
    for axis, sign in open_sides(on_walls):
        middles = _side_middles(lower, upper, spacing_m, axis, sign)
        half_cell = 0.5 * sign * spacing_m * np.eye(3)[axis]
        inner.append(middles - half_cell)
        outer.append(middles + half_cell)
    return Box(lower, upper, spacing_m, np.concatenate(inner), np.concatenate(outer))


def _side_middles(lower: Array, upper: Array, spacing_m: float, axis: int, sign: int) -> Array:
    counts = np.rint((upper - lower) / spacing_m).astype(int)
    coordinates = [
        low + spacing_m * (np.arange(count) + 0.5) for low, count in zip(lower, counts, strict=True)
    ]
    coordinates[axis] = np.array([upper[axis] if sign > 0 else lower[axis]])
    return np.stack(np.meshgrid(*coordinates, indexing="ij"), axis=-1).reshape(-1, 3)
