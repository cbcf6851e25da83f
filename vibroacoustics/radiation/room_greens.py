"""k-Wave's Green's functions of all microphones, several at a time."""

from functools import partial
from typing import Final

from ..base.progress import Progress
from ..base.threads import in_threads, processors
from ..study.radiation import KWAVE_LIMIT_HZ
from . import device, room_grid
from .arrays import Array
from .box import Box, BoxField
from .room_green import kwave_green, memory_bytes
from .task import Task

_SHARE_OF_MEMORY: Final = 0.7


def room_greens(box: Box, task: Task, progress: Progress) -> list[BoxField]:
    """Green's functions of k-Wave's receivers on a box, at its frequencies.

    Raises
    ------
    ParameterError, SolverError
        See `kwave_green`.
    """
    device.warn_of_device()
    settings, walls = task.settings, task.scene.walls
    workers = _workers(box, task)
    threads = max(1, processors() // workers)
    frequency_hz = task.table_hz[task.kwave_table]
    highest_hz = min(settings.maximum_frequency_hz, KWAVE_LIMIT_HZ)
    arguments = (frequency_hz, highest_hz, settings.room_spacing_m, walls)
    return in_threads(
        [
            partial(kwave_green, box, position, *arguments, name, progress, threads)
            for name, position in _positions(task).items()
        ],
        workers,
    )


def _positions(task: Task) -> dict[str, Array]:
    return {name: position for name, position in task.positions.items() if name in task.kwave}


def _workers(box: Box, task: Task) -> int:
    """How many k-Wave runs the processors and the memory of what they run on carry at a time."""
    largest = max(
        memory_bytes(
            room_grid.room_grid(position, box, task.settings.room_spacing_m, task.scene.walls),
            box,
            task.kwave_table.stop,
        )
        for position in _positions(task).values()
    )
    affordable = int(_SHARE_OF_MEMORY * device.available_bytes() / largest)
    return max(1, min(processors(), len(task.kwave), affordable))
