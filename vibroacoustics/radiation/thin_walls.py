"""Walls too thin for a grid: where a cell holds the air of both sides, sound leaks through."""

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..base.errors import ParameterError
from .arrays import Array, IndexArray
from .bodies import Body
from .lines import fluid_on_lines
from .near_grid import NearGrid

Solid = NDArray[np.bool_]

_PARTS: Final = 6
_COARSE_PARTS: Final = 4
"""A cell is looked at in this many parts along each axis, coarsely where there are many cells."""
_MANY_CELLS: Final = 60_000
_SHORT_PATH: Final = 3
"""Cells within which both sides of an edge or a fin are joined: nothing leaks there."""
_MOST_LOOKED_AT: Final = 400
_SMALLEST_LEAK: Final = 0.002
"""Share of the cells with wall that may leak: holes of less than that are below a grid's errors."""
_CELLS_AT_A_TIME: Final = 100_000
THICKNESS_PER_SPACING: Final = 2.6
"""Thickness over the spacing of the finer grid that no cell of the coarser one reaches across."""


def check_walls(body: Body, grid: NearGrid, spacing_m: float) -> None:
    """Refuse a body whose thin walls leak on a grid, the coarser one of a spacing.

    Raises
    ------
    ParameterError
        More than a few cells hold air of both sides of a wall, which meets nowhere near.
    """
    solid, start, parts = solid_parts(body, grid.upper_half)
    leaks, walls = leaking_cells(solid, parts)
    if leaks.shape[0] <= _SMALLEST_LEAK * walls:
        return
    middle = leaks[leaks.shape[0] // 2] + start
    middle_m = [
        float(edges[cell] + edges[cell + 1]) / 2.0
        for edges, cell in zip(grid.upper_half.edges, middle, strict=True)
    ]
    raise ParameterError(
        f"radiation.near_field_spacing_mm = {1e3 * spacing_m:g} mm: "
        f"{100.0 * leaks.shape[0] / walls:.2g} % of the cells with wall ({1e3 * grid.spacing_m:g} "
        f"mm, the coarser grid) hold air of both sides of a thin wall, as at "
        f"{np.round(middle_m, 3).tolist()} m: sound would leak; must be at most the wall's "
        f"thickness / {THICKNESS_PER_SPACING:g}"
    )


def solid_parts(body: Body, grid: NearGrid) -> tuple[Solid, IndexArray, int]:
    """Return the parts of the cells around a body that hold some of it.

    With the first of these cells and the number of parts along each axis of a cell.

    Through the middle of every part run three lines. A wall however thin between two middles is on
    one of them, so that parts on its two sides never touch.
    """
    start, stop = [], []
    for edges, low, high in zip(grid.edges, *body.bounds(), strict=True):
        start.append(max(0, int(np.searchsorted(edges, low)) - 1 - _SHORT_PATH))
        stop.append(min(edges.size - 1, int(np.searchsorted(edges, high)) + _SHORT_PATH))
    cells = np.subtract(stop, start)
    parts = _COARSE_PARTS if np.prod(cells) > _MANY_CELLS else _PARTS
    lines = [
        np.interp(np.arange(parts * count + 1) / parts, np.arange(count + 1), edges[a : b + 1])
        for edges, a, b, count in zip(grid.edges, start, stop, cells, strict=True)
    ]
    solid: Solid = np.zeros([line.size - 1 for line in lines], dtype=bool)
    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        middles = [(lines[other][1:] + lines[other][:-1]) / 2.0 for other in (first, second)]
        air = fluid_on_lines(body, axis, (middles[0], middles[1]), (1, 1), lines[axis])
        solid |= (air < 1.0).transpose(np.argsort((first, second, axis)))
    return solid, np.array(start), parts


def leaking_cells(solid: Solid, parts: int) -> tuple[IndexArray, int]:
    """Cells (leak, 3) that hold air of two sides that do not meet near by; number with wall.

    With more than a few hundred such cells, only some of them are tested, evenly chosen.
    """
    divided, walls = _divided_cells(solid, parts)
    step = -(-divided.shape[0] // _MOST_LOOKED_AT) if divided.size else 1
    chosen = divided[::step]
    leaks = [cell for cell in chosen if not _sides_meet(solid, parts, cell)]
    return np.repeat(np.reshape(np.array(leaks, dtype=np.intp), (-1, 3)), step, axis=0), walls


def _divided_cells(solid: Solid, parts: int) -> tuple[IndexArray, int]:
    """Cells (cell, 3) whose air is in more than one piece; number of cells with wall."""
    shape = [count // parts for count in solid.shape]
    blocks = solid.reshape(shape[0], parts, shape[1], parts, shape[2], parts)
    blocks = blocks.transpose(0, 2, 4, 1, 3, 5).reshape(-1, parts, parts, parts)
    wall = np.flatnonzero(blocks.any(axis=(1, 2, 3)) & ~blocks.all(axis=(1, 2, 3)))
    divided = []
    within = ndimage.generate_binary_structure(3, 1)
    # Blocks stand side by side along a fourth axis, across which nothing is joined.
    joined = np.zeros((3, 3, 3, 3), dtype=bool)
    joined[1] = within
    for some in np.array_split(wall, -(-wall.size // _CELLS_AT_A_TIME)) if wall.size else []:
        labels, _ = ndimage.label(~blocks[some], joined)
        highest = labels.max(axis=(1, 2, 3))
        lowest = np.where(labels > 0, labels, highest[:, None, None, None]).min(axis=(1, 2, 3))
        divided.append(some[highest > lowest])
    cells = np.concatenate(divided) if divided else np.zeros(0, dtype=np.intp)
    return np.stack(np.unravel_index(cells, shape), axis=1), wall.size


def _sides_meet(solid: Solid, parts: int, cell: IndexArray) -> bool:
    """Whether all air of a cell is one piece within a few cells around it."""
    around, inner = [], []
    for index, count in zip(cell, solid.shape, strict=True):
        low = max(0, (int(index) - _SHORT_PATH) * parts)
        around.append(slice(low, min(count, (int(index) + 1 + _SHORT_PATH) * parts)))
        inner.append(slice(int(index) * parts - low, (int(index) + 1) * parts - low))
    labels, _ = ndimage.label(~solid[tuple(around)])
    pieces: Array = np.unique(labels[tuple(inner)])
    return int((pieces > 0).sum()) <= 1
