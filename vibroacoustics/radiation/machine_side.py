"""The machine side on two grids: what every pattern sends through the box, and how sure it is."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from .arrays import Array, ComplexArray, Progress
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

Result = TypeVar("Result")


class MachineSide:
    """Sound pressure of every pattern on the boxes of the finer and the coarser grid.

    Raises
    ------
    ParameterError
        A grid needs more memory than is available.
    SolverError
        A field is not finite or has not died down.
    """

    def __init__(
        self,
        scene: Scene,
        patterns: Sequence[Pattern],
        spacing_m: float,
        maximum_frequency_hz: float,
        frequency_hz: Array,
        progress: Progress,
    ) -> None:
        self.frequency_hz = frequency_hz
        self.walls = scene.walls
        self.near = near_fields(scene, spacing_m, maximum_frequency_hz)
        moving = [scene.moving(pattern) for pattern in patterns]
        for near in self.near:
            near.prepare()
        tasks = [(near, pattern) for near in self.near for pattern in moving]
        fields = in_threads(
            [partial(near.radiate, pattern, frequency_hz, progress) for near, pattern in tasks]
        )
        self.fields: list[list[BoxField]] = [fields[: len(moving)], fields[len(moving) :]]

    def green(self, point: Array, chosen: slice = slice(None)) -> BoxField:
        """Closed-form Green's function of a point on the box of the finer grid."""
        return box_green(self.near[0].box, point, self.frequency_hz[chosen], self.walls)

    def pressures(
        self, point: Array, chosen: slice = slice(None), green: BoxField | None = None
    ) -> tuple[ComplexArray, Array]:
        """Extrapolated pressure at a point and its error, (pattern, frequency), Pa.

        With the closed-form Green's function on both boxes, or another one on the finer grid's; the
        extrapolation is that of the closed form in any case. The error is the estimated one of the
        finer grid, which the extrapolation takes off: what is left was smaller in every test.
        """
        fine, coarse = (
            self._joined(
                number, box_green(near.box, point, self.frequency_hz[chosen], self.walls), chosen
            )
            for number, near in enumerate(self.near)
        )
        correction = EXTRAPOLATION * (fine - coarse)
        if green is not None:
            fine = self._joined(0, green, chosen)
        return fine + correction, np.abs(correction)

    def _joined(self, grid: int, green: BoxField, chosen: slice) -> ComplexArray:
        box = self.near[grid].box
        return np.stack(
            [
                join(box, BoxField(field.inner[chosen], field.outer[chosen]), green)
                for field in self.fields[grid]
            ]
        )


def near_fields(scene: Scene, spacing_m: float, maximum_frequency_hz: float) -> list[NearField]:
    """The scene on the finer and on the coarser grid; nothing is computed yet.

    Raises
    ------
    ParameterError
        A grid needs more memory than is available.
    """
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
