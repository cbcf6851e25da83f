"""Transfer vectors by cut cells: any body, any surroundings."""

from functools import partial
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError
from ..base.progress import Progress
from .arrays import Array, ComplexArray
from .kwave import kwave_version
from .machine_side import (
    COARSENING,
    MachineSide,
    check_memory,
    in_threads,
    near_fields,
    outside,
)
from .near_field import NearField
from .room_green import check_receiver, green_difference_db
from .room_greens import room_greens
from .task import Task

_SOLVERS: Final = {
    "k-wave": "cut cells, k-wave-python {}",
    "closed-form": "cut cells, image sources",
}


class ByCutCells:
    """The machine side on two grids, and the microphones.

    Raises
    ------
    ParameterError
        A receiver lies too close to the machine or behind a wall, or memory does not suffice.
    SolverError
        A field is not finite or has not died down.
    """

    def __init__(self, task: Task, progress: Progress) -> None:
        settings = task.settings
        near = near_fields(task.scene, settings.near_field_spacing_m, settings.maximum_frequency_hz)
        check_memory(near, len(task.patterns), task.frequency_hz.size)
        _check_receivers(task, near)
        self._task = task
        self.side = MachineSide(task.scene, near, task.patterns, task.frequency_hz, progress)

    def at_receivers(self, progress: Progress) -> dict[str, Array | ComplexArray]:
        """Pressures (receiver, pattern, frequency) and errors; with k-Wave its check besides."""
        task, side = self._task, self.side
        positions, chosen = task.positions.values(), slice(0, task.tabulated)
        closed, corrections = (
            np.array(part)
            for part in zip(
                *in_threads([partial(side.pressures, p, chosen) for p in positions]), strict=True
            )
        )
        error = np.abs(corrections)
        if task.settings.room_solver == "closed-form":
            return {"transfer_vector": closed, "transfer_vector_error": error}
        greens = room_greens(side.near[0].box, task, progress)
        difference = [
            green_difference_db(green, side.green(position, chosen))
            for position, green in zip(positions, greens, strict=True)
        ]
        return {
            "transfer_vector": corrections + [side.joined(green, chosen) for green in greens],
            "transfer_vector_error": error,
            "transfer_vector_closed_form": closed,
            "green_difference": np.array(difference),
        }

    def attributes(self) -> dict[str, Any]:
        """What the result says about its solution."""
        grid = self.side.near[0].grid
        return {
            "solver": _SOLVERS[self._task.settings.room_solver].format(kwave_version()),
            "near_field_cells": " x ".join(map(str, grid.shape)),
            "near_field_spacing_m": grid.spacing_m,
            "near_field_time_step_s": grid.time_step_s,
            "near_field_extrapolation": f"from {COARSENING:g} times the spacing, second order",
            "neglected": "echoes of absorbing or distant walls, scattered again by the shell",
        }


def _check_receivers(task: Task, near: list[NearField]) -> None:
    """Refuse what cannot be computed before anything is computed."""
    walls, settings = task.scene.walls, task.settings
    for name, position in task.positions.items():
        if settings.room_solver == "k-wave":
            check_receiver(
                name, position, near[0].box, settings.room_spacing_m, walls, task.tabulated
            )
        if not outside(near, walls, position[None, :])[0]:
            raise ParameterError(
                f"receivers.{name}: stands behind a wall or within "
                f"{1e3 * near[-1].margin_m:.0f} mm of the machine or its cabinet"
            )
