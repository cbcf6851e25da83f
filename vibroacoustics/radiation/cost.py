"""Cost of a computation of the radiation: memory counted, time measured in small parts."""

import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final, NamedTuple

import numpy as np

from ..base.threads import in_threads, processors
from . import kwave, near_memory, room_green
from .box import Box
from .by_cut_cells import ByCutCells
from .near_field import NearField
from .near_step import Fields, pulse_duration_s
from .revolution.method import ByRevolution, join_box
from .revolution.sampling import first_solved
from .revolution.side import memory_bytes
from .room_greens import room_spacing_m
from .room_grid import RoomGrid, room_grid
from .task import Task

LOW: Final = 0.7
HIGH: Final = 1.5
"""Spread of times that are measured once."""
_STEPS: Final = 4
"""Steps that are timed, after a first one."""
_MORE_FREQUENCIES: Final = (2, 6)
"""Times as many as at first are solved: 2.0 to 6.2 in the package's studies."""
_PASSAGES: Final = (10, 60)
"""Passages of sound through the box, in which runs die down; between walls they take longer."""


class Cost(NamedTuple):
    """Cost of work.

    Attributes
    ----------
    name : name of the work
    low_s, high_s : processor time, s, at least and at most
    how : how that is known
    memory_bytes : at its peak, beside what is loaded before
    """

    name: str
    low_s: float
    high_s: float
    how: str
    memory_bytes: float = 0.0


def about(name: str, seconds: float, how: str, times: int = 1) -> Cost:
    """Cost of work whose time was measured once, and that is done so many times."""
    return Cost(name, LOW * times * seconds, HIGH * times * seconds, how)


def processor_time_s(work: Callable[[], object]) -> float:
    """Time that all threads of this process take for some work, s."""
    start = time.process_time()
    work()
    return time.process_time() - start


def cost_of(method: ByRevolution | ByCutCells, task: Task) -> list[Cost]:
    """Cost of the machine side and of each k-Wave run."""
    if isinstance(method, ByRevolution):
        box = join_box(method.side, task.resolving_spacing_m) if task.kwave else None
        costs = [_boundary_elements(method, task)]
    else:
        box, costs = method.near[0].box if task.kwave else None, [_cut_cells(method.near, task)]
    if box is not None:
        costs += [_kwave(name, box, task) for name in task.kwave]
    return costs


def _boundary_elements(method: ByRevolution, task: Task) -> Cost:
    """Three frequencies are solved as a run solves them, with a thread each.

    The first one compiles and prepares the mesh and counts once; how many are needed is only known
    afterwards.
    """
    side, table = method.side, task.table_hz
    points, middle = task.receivers.points, table.size // 2

    def solve(indices: Sequence[int]) -> None:
        in_threads([partial(side.pressures, float(table[index]), points) for index in indices])

    first_s = processor_time_s(lambda: solve([0]))
    one_s = processor_time_s(lambda: solve([middle - 1, middle])) / 2.0
    lines = task.frequency_hz.size - table.size
    first = first_solved(table).size
    low, high = (min(times * first, table.size) for times in _MORE_FREQUENCIES)
    how = (
        f"{first_s:.2g} s for the first, {one_s:.2g} s for each further one of {low + lines} to "
        f"{high + lines} frequencies, measured"
    )
    memory = memory_bytes(side.radiators[0])
    low_s, high_s = (first_s + (count + lines - 1) * one_s for count in (low, high))
    return Cost("boundary elements", low_s, high_s, how, memory)


def _cut_cells(near: list[NearField], task: Task) -> Cost:
    """Steps of both grids are timed; how long sound rings on is only known afterwards."""
    low, high = (sum(_passages_s(grid, count) for grid in near) for count in _PASSAGES)
    patterns, parts = len(task.patterns), 2 if near[0].grid.mirrored else 1
    memory = near_memory.memory_bytes(near, patterns, task.frequency_hz.size, len(task.kwave))
    how = f"{patterns} motions until they die down, a few steps measured"
    return Cost("cut cells", patterns * low, patterns * parts * high, how, memory)


def _passages_s(near: NearField, passages: int) -> float:
    grid = near.grid
    upper = grid.upper_half
    faces = [tuple(n + (axis == along) for axis, n in enumerate(upper.shape)) for along in range(3)]
    fields = Fields(upper, [np.ones(shape) for shape in faces], np.ones(upper.shape), ())
    step_s = _step_s(fields.advance)
    duration_s = pulse_duration_s(near.pulse_width_s) + passages * near.passage_s
    return step_s * duration_s / grid.time_step_s


def _step_s(step: Callable[[], None]) -> float:
    """Processor time of one step, after the first, which may compile."""
    step()
    start = time.process_time()
    for _ in range(_STEPS):
        step()
    return (time.process_time() - start) / _STEPS


def _kwave(name: str, box: Box, task: Task) -> Cost:
    grid = room_grid(task.positions[name], box, room_spacing_m(box, task), task.scene.walls)
    steps = room_green.steps_of(grid, box, task.kwave_highest_hz)[1]
    total_s = steps * _kwave_step_s(grid)
    x, y, z = grid.shape
    how = f"{steps} steps on {x}×{y}×{z} nodes, {_STEPS} of them measured"
    memory = room_green.memory_bytes(grid, box, task.kwave_table.stop)
    return about(f"k-Wave {name}", total_s, how)._replace(memory_bytes=memory)


def _kwave_step_s(grid: RoomGrid) -> float:
    """Time of one step."""
    engine = kwave.build_engine(grid, np.zeros(2), _STEPS, processors())
    try:
        return _step_s(engine.step)
    finally:
        engine.close()
