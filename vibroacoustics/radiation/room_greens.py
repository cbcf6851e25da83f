"""k-Wave's Green's functions of all microphones, several at a time; the spacing of their grids."""

from functools import partial
from typing import Final

from ..base.forms import returned
from ..base.pieces import stored
from ..base.progress import Progress
from ..base.threads import mapped_in_threads, processors
from . import device, room_grid
from .arrays import Array
from .box import Box, BoxField
from .room_green import CLEAR_NODES, check_receiver, clearance_m, kwave_green, memory_bytes
from .task import Task

_SHARE_OF_MEMORY: Final = 0.7
_SMALLEST_SPACING_M: Final = 0.005
"""Smallest spacing of an automatic grid, and of one that a study may give."""


def room_greens(box: Box, task: Task, progress: Progress) -> list[BoxField]:
    """Green's functions of k-Wave's receivers on a box, at its frequencies.

    Raises
    ------
    ParameterError, SolverError
        See `kwave_green`.
    """
    device.warn_of_device()
    walls = task.scene.walls
    workers = _workers(box, task)
    threads = max(1, processors() // workers)
    frequency_hz = task.table_hz[task.kwave_table]
    arguments = (frequency_hz, task.kwave_highest_hz, room_spacing_m(box, task), walls)

    def green(microphone: tuple[str, Array]) -> BoxField:
        name, position = microphone
        return kwave_green(box, position, *arguments, name, progress, threads)

    in_parallel = partial(mapped_in_threads, green, workers=workers)
    name = "k-Wave", device.engine_name(), frequency_hz
    return list(stored(name, _positions(task).items(), in_parallel, returned(green)))


def room_spacing_m(box: Box, task: Task) -> float:
    """Largest node spacing of k-Wave's grids, m: the study's, or automatic.

    The automatic one resolves the highest frequency, and the microphone nearest to the box stands
    as many nodes off it as the stencil between them needs.
    """
    resolving_m = task.resolving_spacing_m
    if task.settings.room_spacing_m is not None:
        return resolving_m
    clear_m = min(float(clearance_m(box, position).max()) for position in _positions(task).values())
    return min(resolving_m, max(clear_m / (CLEAR_NODES + 1), _SMALLEST_SPACING_M))


def check_receivers(box: Box, task: Task) -> None:
    """Check positions and memory of all k-Wave runs, before any run.

    Raises
    ------
    ParameterError
        See `kwave_green`.
    """
    for name, position in _positions(task).items():
        spacing_m = room_spacing_m(box, task)
        check_receiver(name, position, box, spacing_m, task.scene.walls, task.kwave_table.stop)


def _positions(task: Task) -> dict[str, Array]:
    return {name: position for name, position in task.positions.items() if name in task.kwave}


def _workers(box: Box, task: Task) -> int:
    """Number of k-Wave runs that processors and memory allow at a time."""
    spacing_m, walls = room_spacing_m(box, task), task.scene.walls
    largest = max(
        memory_bytes(
            room_grid.room_grid(position, box, spacing_m, walls), box, task.kwave_table.stop
        )
        for position in _positions(task).values()
    )
    affordable = int(_SHARE_OF_MEMORY * device.available_bytes() / largest)
    return max(1, min(processors(), len(task.kwave), affordable))
