"""k-Wave's Green's functions of microphones, spacing of grids, and transfer vectors with them."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np

from ..base.forms import returned
from ..base.pieces import stored
from ..base.progress import Progress
from ..base.threads import mapped_in_threads, processors
from . import device, room_grid
from .arrays import Array, ComplexArray
from .box import Box, BoxField
from .exact import box_green
from .kwave import kwave_version
from .receiver_methods import closed_form, machine_side
from .room_green import (
    CLEAR_NODES,
    check_receiver,
    clearance_m,
    green_difference_db,
    kwave_green,
    memory_bytes,
)
from .task import Task

_SILENT: Final = 1e-5
"""Share of the loudest motion's pressure below which k-Wave's error, some 1e-4 of it, is larger."""
Vectors = dict[str, Array | ComplexArray]


def solver(task: Task) -> str:
    """Name the solver in words."""
    room = f"k-wave-python {kwave_version()}" if task.kwave else closed_form(task.settings)
    return f"{machine_side(task.settings)}, {room}"


def closed_greens(box: Box, task: Task) -> Iterator[BoxField]:
    """Green's functions in closed form to the microphones that k-Wave computes."""
    microphones = task.kwave_microphones
    for point in microphones.points:
        yield box_green(box, point, task.frequency_hz[microphones.frequencies], task.scene.walls)


def with_kwave(
    task: Task, closed: Mapping[str, Array | ComplexArray], kwave: Vectors, difference_db: Array
) -> Vectors:
    """Transfer vectors in which k-Wave's take the place of those with the closed form.

    A motion that the closed form has silent at a microphone, as by symmetry, stays silent: k-Wave's
    grid is not symmetric, and its error would sound in its place.

    Parameters
    ----------
    task : says at which microphones and frequencies
    closed : `transfer_vector` and its error by name, (receiver, pattern, frequency)
    kwave : Green's functions of k-Wave's microphones and frequencies alone
    difference_db : difference of the Green's functions, shape (microphone of k-Wave,
        frequency)
    """
    rows, table = task.kwave_rows, task.kwave_table
    joined = {name: values.copy() for name, values in closed.items()}
    size = np.abs(closed["transfer_vector"][rows, :, table])
    silent = size <= _SILENT * size.max(axis=1, keepdims=True)
    for name, values in kwave.items():
        joined[name][rows, :, table] = np.where(silent, joined[name][rows, :, table], values)
    difference = np.full((len(task.positions), task.tabulated), np.nan)
    difference[rows, table] = difference_db
    return {
        **joined,
        "transfer_vector_closed_form": closed["transfer_vector"],
        "green_difference": difference,
    }


def differences_db(greens: Sequence[BoxField], expected: Iterator[BoxField]) -> Array:
    """Difference of k-Wave's Green's functions from the closed form, where it is largest on the
    box."""
    return np.array(list(map(green_difference_db, greens, expected)))


_SHARE_OF_MEMORY: Final = 0.7
_SMALLEST_SPACING_M: Final = 0.005
"""Smallest spacing of an automatic grid, and of one that a study may give."""


def room_greens(box: Box, task: Task, progress: Progress) -> list[BoxField]:
    """Green's functions of k-Wave's receivers on a box, at its frequencies."""
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
    """Check positions and memory of all k-Wave runs, before any run."""
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
