"""The air of a room cut into boxes along the planes of its furniture, and where they meet."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ...base.errors import ParameterError
from ..arrays import Array
from .room import Material, Room

_SAME_PLANE_M = 1e-6
_THIN_M = 0.05
"""Gaps of air of so much are taken whatever the spacing: the step that they ask for is that of a
room to 1 kHz."""
Ranges = tuple[tuple[int, int], ...]
"""First cell and the one after the last along each axis."""


@dataclass(frozen=True)
class AirBox:
    """A cuboid of air whose pressure is one cosine series."""

    lower: Array
    upper: Array
    nodes: tuple[int, int, int]
    """Terms of the series along each axis, as many as nodes."""

    @property
    def size(self) -> Array:
        """Lengths of the edges, m."""
        return np.asarray(self.upper - self.lower)

    @property
    def spacing(self) -> Array:
        """Spacing of the nodes, m."""
        return np.asarray(self.size / np.array(self.nodes))


@dataclass(frozen=True)
class End:
    """A side of an air box: which box, axis, and 0 for its lower or 1 for its upper side."""

    box: int
    axis: int
    end: int


@dataclass(frozen=True)
class Face:
    """A rectangle where air ends: a joint between two boxes, or a wall behind one."""

    ends: tuple[End, ...]
    """Two boxes at a joint, of which the first lies below; one at a wall."""
    lower: Array
    """Corner along the two axes of the face, in their order, m, (2,)."""
    upper: Array
    material: Material | None = None


def cut(room: Room, spacing_m: float, least_nodes: int = 2) -> tuple[AirBox, ...]:
    """Boxes of air of a room, the largest first.

    A box has as many nodes along an axis as keep to the spacing, and `least_nodes` at least.

    Raises
    ------
    ParameterError
        There is no air, or a gap of it is thinner than half the spacing and 50 mm: its nodes would
        force tiny time steps on the room.
    """
    lines = _planes(room)
    middles = np.stack(np.meshgrid(*((a[1:] + a[:-1]) / 2.0 for a in lines), indexing="ij"), -1)
    air = np.ones(middles.shape[:3], dtype=bool)
    for block in room.blocks:
        air &= ~np.all((middles > block.lower) & (middles < block.upper), axis=-1)
    if not air.any():
        raise ParameterError("room.furniture: leave no air in the room")
    boxes = []
    for ranges in rectangles(air, lines):
        lower = np.array([line[a] for line, (a, _) in zip(lines, ranges, strict=True)])
        upper = np.array([line[b] for line, (_, b) in zip(lines, ranges, strict=True)])
        _check_gap(lower, upper, spacing_m, least_nodes)
        nodes = np.maximum(np.ceil((upper - lower) / spacing_m - 1e-6), least_nodes).astype(int)
        boxes.append(AirBox(lower, upper, (int(nodes[0]), int(nodes[1]), int(nodes[2]))))
    return tuple(boxes)


def _planes(room: Room) -> list[Array]:
    """Planes of walls and blocks along each axis, rising; those of one place once."""
    lines = []
    for axis, size in enumerate(room.size_m):
        edges = [edge for block in room.blocks for edge in (block.lower[axis], block.upper[axis])]
        line = np.unique(np.clip([0.0, size, *edges], 0.0, size))
        lines.append(line[np.append(True, np.diff(line) > _SAME_PLANE_M)])
    return lines


def _check_gap(lower: Array, upper: Array, spacing_m: float, least_nodes: int) -> None:
    thinnest = int(np.argmin(upper - lower))
    gap = float(upper[thinnest] - lower[thinnest])
    least = min(_THIN_M, 0.25 * least_nodes * spacing_m) if least_nodes > 1 else 0.0
    if gap < least:
        raise ParameterError(
            f"room.furniture: leave air of {1e3 * gap:.3g} mm at {'xyz'[thinnest]} = "
            f"{lower[thinnest]:.4g} m; needed at least {1e3 * least:.3g} mm: close the gap, widen "
            f"it, or take a smaller spacing"
        )


def faces(room: Room, boxes: Sequence[AirBox]) -> tuple[Face, ...]:
    """Seams between the boxes, and walls that are not hard."""
    return (*_seams(boxes), *_walls(room, boxes))


def _seams(boxes: Sequence[AirBox]) -> Iterator[Face]:
    for below, first in enumerate(boxes):
        for above, second in enumerate(boxes):
            for axis in range(3):
                if abs(first.upper[axis] - second.lower[axis]) > _SAME_PLANE_M:
                    continue
                lower = np.delete(np.maximum(first.lower, second.lower), axis)
                upper = np.delete(np.minimum(first.upper, second.upper), axis)
                if np.all(upper - lower > _SAME_PLANE_M):
                    yield Face((End(below, axis, 1), End(above, axis, 0)), lower, upper)


def _walls(room: Room, boxes: Sequence[AirBox]) -> Iterator[Face]:
    """Each side of each box is cut where blocks and patches end, and put together by material."""
    for number, box in enumerate(boxes):
        for axis in range(3):
            across = [other for other in range(3) if other != axis]
            lines = [_lines_across(room, box, axis, other) for other in across]
            for end in (0, 1):
                yield from _walls_of_side(room, box, End(number, axis, end), lines)


def _walls_of_side(room: Room, box: AirBox, side: End, lines: list[Array]) -> Iterator[Face]:
    middles = [(line[1:] + line[:-1]) / 2.0 for line in lines]
    level = (box.upper if side.end else box.lower)[side.axis]
    behind = {
        (i, j): room.material(side.axis, side.end, np.insert([u, v], side.axis, level))
        for i, u in enumerate(middles[0])
        for j, v in enumerate(middles[1])
    }
    for material in dict.fromkeys(behind.values()):
        if material is None or material.hard:
            continue
        chosen = np.zeros((middles[0].size, middles[1].size), dtype=bool)
        for cell, behind_cell in behind.items():
            chosen[cell] = behind_cell == material
        for ranges in rectangles(chosen, lines):
            lower = np.array([line[a] for line, (a, _) in zip(lines, ranges, strict=True)])
            upper = np.array([line[b] for line, (_, b) in zip(lines, ranges, strict=True)])
            yield Face((side,), lower, upper, material)


def _lines_across(room: Room, box: AirBox, axis: int, other: int) -> Array:
    """Cuts of a side of a box across `axis` along another axis."""
    from .room import SIDES

    edges = [edge for block in room.blocks for edge in (block.lower[other], block.upper[other])]
    for patch in room.patches:
        if SIDES[patch.side][0] == axis:
            row = [other_axis for other_axis in range(3) if other_axis != axis].index(other)
            edges += [patch.lower[row], patch.upper[row]]
    low, high = box.lower[other], box.upper[other]
    line = np.unique(np.clip([low, high, *edges], low, high))
    kept: Array = line[np.append(True, np.diff(line) > _SAME_PLANE_M)]
    kept[-1] = high
    return kept


def rectangles(chosen: NDArray[np.bool_], lines: list[Array]) -> Iterator[Ranges]:
    """Rectangles that cover the chosen cells once; `lines` bound the cells along each axis, m."""
    remaining = chosen.copy()
    while remaining.any():
        ranges = _largest(remaining, lines)
        remaining[tuple(slice(*span) for span in ranges)] = False
        yield ranges


def _largest(chosen: NDArray[np.bool_], lines: list[Array]) -> Ranges:
    """The rectangle of the largest measure that holds chosen cells alone."""
    count = np.pad(chosen.astype(int), [(1, 0)] * chosen.ndim)
    for axis in range(chosen.ndim):
        count = np.cumsum(count, axis=axis)
    starts, stops = zip(*(np.triu_indices(number) for number in chosen.shape), strict=True)
    stops = tuple(stop + 1 for stop in stops)
    cells = np.ones([start.size for start in starts], dtype=int)
    measure = np.ones(cells.shape)
    for axis, (start, stop, line) in enumerate(zip(starts, stops, lines, strict=True)):
        form = [-1 if other == axis else 1 for other in range(chosen.ndim)]
        cells = cells * (stop - start).reshape(form)
        measure = measure * (line[stop] - line[start]).reshape(form)
    held = np.zeros(cells.shape, dtype=int)
    for ends in product((0, 1), repeat=chosen.ndim):
        corner = np.ix_(*((stops if end else starts)[axis] for axis, end in enumerate(ends)))
        held += (-1) ** (chosen.ndim - sum(ends)) * count[corner]
    best = np.unravel_index(np.argmax(np.where(held == cells, measure, 0.0)), cells.shape)
    return tuple(
        (int(start[index]), int(stop[index]))
        for start, stop, index in zip(starts, stops, best, strict=True)
    )
