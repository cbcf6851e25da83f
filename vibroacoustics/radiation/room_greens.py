"""k-Wave's Green's functions of all microphones, several at a time."""

from functools import partial
from typing import Final

import psutil

from ..base.progress import Progress
from ..base.threads import in_threads, processors
from . import room_grid
from .box import Box, BoxField
from .room_green import kwave_green, memory_bytes
from .task import Task

_SHARE_OF_MEMORY: Final = 0.7


def room_greens(box: Box, task: Task, progress: Progress) -> list[BoxField]:
    """Green's functions of the receivers on a box by k-Wave.

    Raises
    ------
    ParameterError, SolverError
        See `kwave_green`.
    """
    settings, walls = task.settings, task.scene.walls
    workers = _workers(box, task)
    threads = max(1, processors() // workers)
    arguments = (task.table_hz, settings.maximum_frequency_hz, settings.room_spacing_m, walls)
    return in_threads(
        [
            partial(kwave_green, box, position, *arguments, name, progress, threads)
            for name, position in task.positions.items()
        ],
        workers,
    )


def _workers(box: Box, task: Task) -> int:
    """How many k-Wave runs the processors and the memory carry at a time."""
    largest = max(
        memory_bytes(
            room_grid.room_grid(position, box, task.settings.room_spacing_m, task.scene.walls),
            box,
            task.tabulated,
        )
        for position in task.positions.values()
    )
    affordable = int(_SHARE_OF_MEMORY * psutil.virtual_memory().available / largest)
    return max(1, min(processors(), len(task.positions), affordable))
