"""Transfer vectors by cut cells: any body, any surroundings."""

from collections.abc import Sequence
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import RIGID_BODY_DOFS
from ..study.radiation import BODY_SPACING_M, RadiationSettings
from .arrays import Array, ComplexArray
from .at_kwave import Vectors, closed_greens, differences_db, solver, with_kwave
from .machine_side import (
    COARSENING,
    MachineSide,
    Radiated,
    Room,
    near_fields,
    outside,
)
from .near_field import NearField
from .near_memory import check_memory
from .neglected_echo import SAFETY, neglected_echo
from .room_greens import check_receivers, room_greens
from .scene import Scene
from .task import Microphones, Task
from .thin_walls import check_walls

_LARGEST_MEAN_ERROR: Final = 0.3
"""Share of a translation's pressure that its estimated error may be, in the mean: 2.3 dB."""

_LOUD: Final = 0.1
"""Share of the loudest translation's pressure above which a translation is loud."""

_BODY_SHARE: Final = 0.5
"""Cell size over volume per area: a fifth of the radius of a compressor's shell."""


class ByCutCells:
    """The machine side on two grids, and the microphones.

    Raises
    ------
    ParameterError
        A receiver lies too close to the machine or behind a wall, memory does not suffice, or
        walls are too thin for the grids.
    """

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

        Raises
        ------
        ParameterError
            The grids do not resolve walls or gaps.
        SolverError
            A field is not finite or has not died down.
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
