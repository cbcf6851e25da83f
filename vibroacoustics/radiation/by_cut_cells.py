"""Transfer vectors by cut cells: any body, any surroundings."""

from collections.abc import Sequence
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import RIGID_BODY_DOFS
from ..study.radiation import BODY_SPACING_M, RadiationSettings
from .arrays import Array, ComplexArray, IndexArray
from .bodies import Body
from .lines import fluid_on_lines
from .machine_side import COARSENING, MachineSide, Radiated, Room, near_fields, outside
from .near_field import NearField
from .near_grid import NearGrid
from .near_memory import check_memory
from .neglected_echo import SAFETY, neglected_echo
from .room_greens import (
    Vectors,
    check_receivers,
    closed_greens,
    differences_db,
    room_greens,
    solver,
    with_kwave,
)
from .scene import Scene
from .task import Microphones, Task

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


_LARGEST_MEAN_ERROR: Final = 0.3
"""Share of a translation's pressure that its estimated error may be, in the mean: 2.3 dB."""

_LOUD: Final = 0.1
"""Share of the loudest translation's pressure above which a translation is loud."""

_BODY_SHARE: Final = 0.5
"""Cell size over volume per area: a fifth of the radius of a compressor's shell."""


class ByCutCells:
    """The machine side on two grids, and the microphones."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._spacing_m = near_spacing_m(task.scene, task.settings)
        self.near = near_fields(task.scene, self._spacing_m, task.settings.maximum_frequency_hz)
        check_memory(self.near, len(task.patterns), task.frequency_hz.size, len(task.kwave))
        _check_receivers(task, self.near)
        check_walls(task.scene.body, self.near[-1].grid, self._spacing_m)

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (point, 3) lie outside the boxes and in front of every wall."""
        return outside(self.near, self._task.scene.walls, points)

    def pressures(
        self, elsewhere: Sequence[Microphones], progress: Progress
    ) -> tuple[Vectors, list[ComplexArray]]:
        """Pressures (receiver, pattern, frequency) and errors; with k-Wave its check besides.

        And pressures (point, pattern, frequency) elsewhere.
        """
        task, near = self._task, self.near
        room = Room(task.kwave_microphones, partial(room_greens, near[0].box, task, progress))
        side = MachineSide(
            task.scene,
            near,
            task.patterns,
            task.frequency_hz,
            [task.receivers, *elsewhere],
            progress,
            room if task.kwave else None,
        )
        closed, *others = side.closed
        check_grids_agree(closed, self._spacing_m)
        vectors: Vectors = {
            "transfer_vector": closed.pressure,
            "transfer_vector_error": with_neglected_echo(closed, task),
        }
        if side.in_room is not None:
            correction = closed.correction[task.kwave_rows, :, task.kwave_table]
            difference_db = differences_db(side.greens, closed_greens(near[0].box, task))
            kwave: Vectors = {"transfer_vector": correction + side.in_room}
            vectors = with_kwave(task, vectors, kwave, difference_db)
        return vectors, [radiated.pressure for radiated in others]

    def attributes(self) -> dict[str, Any]:
        """Return attributes of the result on its solution."""
        grid = self.near[0].grid
        return {
            "solver": solver(self._task),
            "near_field_cells": " x ".join(map(str, grid.shape)),
            "near_field_spacing_m": grid.spacing_m,
            "near_field_time_step_s": grid.time_step_s,
            "near_field_extrapolation": f"from {COARSENING:g} times the spacing, second order",
            "neglected": "echoes of absorbing or distant walls, scattered again by the shell "
            "(in the estimated error)",
        }


def near_spacing_m(scene: Scene, settings: RadiationSettings) -> float:
    """Cell size of the finer grid, m: the study's, or automatic.

    The automatic one resolves the shortest wave, the machine's body and a cabinet's panels, which
    no cell of the coarser grid reaches across.
    """
    if settings.near_field_spacing_m is not None:
        return settings.near_field_spacing_m
    body_m = max(_BODY_SHARE * scene.machine.volume_per_area_m, BODY_SPACING_M)
    spacing_m = min(settings.wave_spacing_m, body_m)
    cabinet = settings.surroundings.cabinet
    return spacing_m if cabinet is None else min(spacing_m, cabinet.panel_thickness_m / COARSENING)


def with_neglected_echo(closed: Radiated, task: Task) -> Array:
    """Return the estimated error at the microphones, (receiver, pattern, frequency), Pa."""
    share = neglected_echo(task.scene, task.patterns, task.table_hz, task.receivers.points)
    largest = np.abs(closed.pressure).max(axis=0)
    return np.asarray(closed.error + SAFETY * share * largest)


def _check_receivers(task: Task, near: list[NearField]) -> None:
    """Refuse what cannot be computed before anything is computed."""
    check_receivers(near[0].box, task)
    for name, position in task.positions.items():
        if not outside(near, task.scene.walls, position[None, :])[0]:
            raise ParameterError(
                f"receivers.{name}: stands behind a wall or within "
                f"{1e3 * near[-1].margin_m:.0f} mm of the machine or its cabinet"
            )


def check_grids_agree(radiated: Radiated, spacing_m: float) -> None:
    """Refuse the strong motions for which the finer and the coarser grid differ.

    A motion counts at the frequencies at which it is loud at the microphones: by symmetry, one
    along y is silent at microphones in the plane y = 0.

    Raises
    ------
    ParameterError
        The estimated error of a translation is too large in the mean over the frequencies.
    """
    errors, pressures = (
        np.linalg.norm(values[:, :3], axis=0) for values in (radiated.correction, radiated.pressure)
    )
    loudest = pressures.max(axis=0)
    for dof, error, pressure in zip(RIGID_BODY_DOFS, errors, pressures, strict=False):
        loud = (pressure > _LOUD * loudest) & (loudest > 0.0)
        shares = np.minimum(error[loud] / pressure[loud], 1.0)
        if shares.size and shares.mean() > _LARGEST_MEAN_ERROR:
            raise ParameterError(
                f"radiation.near_field_spacing_mm = {1e3 * spacing_m:g} mm: "
                f"resolves walls or gaps too badly: the estimated error of {dof} is in the mean "
                f"over the frequencies {100.0 * shares.mean():.0f} % of its pressure, must be at "
                f"most {100.0 * _LARGEST_MEAN_ERROR:g} %"
            )
