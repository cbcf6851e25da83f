"""The closed box on which the machine side and the room side meet."""

from dataclasses import dataclass

import numpy as np

from .arrays import Array, ComplexArray


@dataclass(frozen=True)
class Box:
    """Pairs of points, half a cell inside and half a cell outside each cell face of a box.

    Values on both layers stand for value and normal gradient. Above a hard floor the box has five
    sides and ends on the floor: pressure and Green's function both have zero normal derivative
    there, so the missing side would contribute nothing.
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


def box_sides(on_floor: bool) -> list[tuple[int, int]]:
    """(axis, sign) of the sides of a box; without the bottom when it ends on the floor."""
    sides = [(axis, sign) for axis in range(3) for sign in (-1, 1)]
    return [side for side in sides if not (on_floor and side == (2, -1))]


def closed_box(lower: Array, upper: Array, spacing_m: float, on_floor: bool) -> Box:
    """All sides of a box whose edges are whole numbers of the spacing."""
    inner, outer = [], []
    for axis, sign in box_sides(on_floor):
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
