"""The machine side on two grids: what every pattern sends through the box, and how sure it is."""

import itertools
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Final, TypeVar

import numpy as np
import psutil
from numpy.typing import NDArray

from ..base.errors import ParameterError
from ..base.progress import Progress
from .arrays import Array, ComplexArray
from .box import BoxField
from .exact import box_green
from .join import join
from .mirrors import Mirror
from .near_field import NearField
from .patterns import Pattern
from .scene import Scene

_UNIT_CELLS: Final = 3
"""Cells of the finer grid where the coarser one has one less, so that both have the same planes."""
COARSENING: Final = _UNIT_CELLS / (_UNIT_CELLS - 1)
"""Spacing of the coarser grid over that of the finer one."""
EXTRAPOLATION: Final = 1.0 / (COARSENING**2 - 1.0)
"""Richardson: the finer grid errs by this share of the difference at second order."""
_POINTS_PER_TASK: Final = 16

Result = TypeVar("Result")


class MachineSide:
    """Sound pressure of every pattern on the boxes of the finer and the coarser grid.

    Raises
    ------
    SolverError
        A field is not finite or has not died down.
    """

    def __init__(
        self,
        scene: Scene,
        near: Sequence[NearField],
        patterns: Sequence[Pattern],
        frequency_hz: Array,
        progress: Progress,
    ) -> None:
        self.frequency_hz = frequency_hz
        self.walls = scene.walls
        self.near = near
        moving = [scene.moving(pattern) for pattern in patterns]
        fluxes = in_threads([partial(grid.wall_fluxes, moving) for grid in near])
        tasks = [
            partial(grid.radiate, flux, frequency_hz, pattern.name, progress)
            for grid, by_pattern in zip(near, fluxes, strict=True)
            for pattern, flux in zip(patterns, by_pattern, strict=True)
        ]
        fields = in_threads(tasks)
        self.fields: list[list[BoxField]] = [fields[: len(moving)], fields[len(moving) :]]

    def green(self, point: Array, chosen: slice = slice(None)) -> BoxField:
        """Closed-form Green's function of a point on the box of the finer grid."""
        return box_green(self.near[0].box, point, self.frequency_hz[chosen], self.walls)

    def pressures(
        self, point: Array, chosen: slice = slice(None)
    ) -> tuple[ComplexArray, ComplexArray]:
        """Extrapolated pressure at a point and its correction, (pattern, frequency), Pa.

        With the closed-form Green's function on both boxes. The correction, which the pressure
        holds, is the estimated error of the finer grid; no bound of what is left is known.
        """
        fine, coarse = (
            self._joined(
                number, box_green(near.box, point, self.frequency_hz[chosen], self.walls), chosen
            )
            for number, near in enumerate(self.near)
        )
        correction = EXTRAPOLATION * (fine - coarse)
        return fine + correction, correction

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (point, 3) lie outside the boxes and in front of every wall."""
        return outside(self.near, self.walls, points)

    def at_points(
        self, points: Array, chosen: slice, name: str, progress: Progress
    ) -> ComplexArray:
        """Extrapolated pressure at points (point, 3), (point, pattern, frequency), Pa."""
        shape = (len(points), len(self.fields[0]), self.frequency_hz[chosen].size)
        result = np.zeros(shape, dtype=complex)
        parts = np.array_split(np.arange(len(points)), -(-len(points) // _POINTS_PER_TASK))
        done = itertools.count(1)

        def fill(indices: NDArray[np.intp]) -> None:
            for index in indices:
                result[index] = self.pressures(points[index], chosen)[0]
            progress(name, next(done), len(parts))

        in_threads([partial(fill, part) for part in parts])
        return result

    def joined(self, green: BoxField, chosen: slice = slice(None)) -> ComplexArray:
        """Pressure (pattern, frequency), Pa, where a Green's function on the finer box leads."""
        return self._joined(0, green, chosen)

    def _joined(self, grid: int, green: BoxField, chosen: slice) -> ComplexArray:
        box = self.near[grid].box
        return np.stack(
            [
                join(box, BoxField(field.inner[chosen], field.outer[chosen]), green)
                for field in self.fields[grid]
            ]
        )


def near_fields(scene: Scene, spacing_m: float, maximum_frequency_hz: float) -> list[NearField]:
    """The scene on the finer and on the coarser grid; nothing is computed yet."""
    return [
        NearField(
            scene.body,
            _UNIT_CELLS / cells * spacing_m,
            maximum_frequency_hz,
            scene.near_walls,
            cells_per_unit=cells,
        )
        for cells in (_UNIT_CELLS, _UNIT_CELLS - 1)
    ]


def check_memory(near: Sequence[NearField], patterns: int, frequencies: int) -> None:
    """Refuse grids that do not fit.

    Raises
    ------
    ParameterError
        They need more memory than is available.
    """
    needed = memory_bytes(near, patterns, frequencies) / 2**30
    available = psutil.virtual_memory().available / 2**30
    if needed > available:
        x, y, z = near[0].grid.shape
        raise ParameterError(
            f"radiation.near_field_spacing_mm: the grid of {x}×{y}×{z} cells for {patterns} motions"
            f" and {frequencies} frequencies needs {needed:.3g} GiB, {available:.3g} GiB are "
            "available"
        )


def memory_bytes(near: Sequence[NearField], patterns: int, frequencies: int) -> float:
    """Memory that a `MachineSide` takes at its peak, beside what is loaded before."""
    geometry, result, run = np.transpose([grid.memory_bytes(frequencies) for grid in near])
    return float(geometry.sum() + patterns * result.sum() + run.max() * min(processors(), patterns))


def outside(near: Sequence[NearField], walls: Sequence[Mirror], points: Array) -> NDArray[np.bool_]:
    """Whether points (point, 3) lie outside the boxes of all grids and in front of every wall."""
    in_box = []
    for box in (one.box for one in near):
        # A point on a wall beside a box lies in it.
        low = np.minimum(box.lower, box.outer.min(axis=0)) - 1e-6
        high = np.maximum(box.upper, box.outer.max(axis=0)) + 1e-6
        in_box.append(np.all((points > low) & (points < high), axis=1))
    behind = [wall.depth_m(points) < -1e-9 for wall in walls]
    clear: NDArray[np.bool_] = ~np.any([*in_box, *behind], axis=0)
    return clear


def in_threads(tasks: Sequence[Callable[[], Result]], workers: int | None = None) -> list[Result]:
    """Results of tasks that mostly compute without the interpreter's lock, in their order.

    The first error ends what has not begun.
    """
    with ThreadPoolExecutor(workers or processors()) as pool:
        futures = [pool.submit(task) for task in tasks]
        try:
            return [future.result() for future in futures]
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
