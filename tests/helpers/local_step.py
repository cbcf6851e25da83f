"""The second method: seven points in space, three in time, walls half a cell off the pressure.

Simple, for any shape that cells fill, and good at low frequencies; waves along the axes are slow.
"""

from collections.abc import Mapping
from functools import partial
from typing import Any, Final

import numpy as np
from local_grid import LocalGrid, local_grid

from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S
from vibroacoustics.base.progress import Progress, no_progress
from vibroacoustics.base.threads import in_threads
from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.near_step import RunningTransform, transform
from vibroacoustics.radiation.rooms.box_step import fast_kernel
from vibroacoustics.radiation.rooms.diffuse import reverberation_time_s
from vibroacoustics.radiation.rooms.room import Room
from vibroacoustics.radiation.rooms.settings import RoomSettings
from vibroacoustics.radiation.rooms.wall_step import WallPatch, Walls, pass_walls

_BELOW_LIMIT: Final = 0.999
_PROGRESS_STEPS: Final = 200


def local_transfer(
    room: Room,
    points: Array,
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    spacing_m: float,
    settings: RoomSettings | None = None,
    progress: Progress = no_progress,
    workers: int | None = None,
) -> dict[str, ComplexArray]:
    """Green's functions between microphones (3,) and points (point, 3), (frequency, point), 1/m.

    As `room_transfer`, by the local scheme. Runs last as long as settings say, or the
    reverberation time.
    """
    settings = settings or RoomSettings()
    grid = local_grid(room, spacing_m)
    longest = settings.longest_s or reverberation_time_s(room)
    runs = [
        partial(_run, grid, points, position, frequency_hz, settings, longest, name, progress)
        for name, position in microphones.items()
    ]
    return dict(zip(microphones, in_threads(runs, workers), strict=True))


def largest_step_s(spacing: Array) -> float:
    """c dt = 1/sqrt(sum of 1/h²): no row of the operator has a sum of magnitudes above 4.

    A wall's half cell of air adds to its cell what the missing neighbour would (Gershgorin).
    """
    return float(1.0 / (SPEED_OF_SOUND_M_PER_S * np.sqrt((1.0 / spacing**2).sum())))


def _run(
    grid: LocalGrid,
    points: Array,
    microphone: Array,
    frequency_hz: Array,
    settings: RoomSettings,
    longest_s: float,
    name: str,
    progress: Progress,
) -> ComplexArray:
    step_s = _BELOW_LIMIT * min(largest_step_s(grid.spacing), settings.longest_step_s)
    time, force = settings.force(step_s)
    every = settings.sampling_steps(step_s)
    steps = int(np.ceil((time[-1] + longest_s) / step_s))
    field = LocalField(grid, step_s)
    at, share = grid.weights(microphone)
    push = share * (SPEED_OF_SOUND_M_PER_S * step_s) ** 2 / np.prod(grid.spacing)
    readings = [grid.weights(point) for point in points]
    record = RunningTransform(frequency_hz, len(readings))
    for step in range(steps):
        field.advance()
        if step < force.size:
            field.pressure.reshape(-1)[at] += force[step] * push
        if step % every == 0:
            flat = field.pressure.reshape(-1)
            record.next_row((step + 1) * step_s)[...] = [flat[i] @ w for i, w in readings]
        if step % _PROGRESS_STEPS == 0:
            progress(f"room {name}", step, steps)
    progress(f"room {name}", steps, steps)
    return record.spectrum() * (every / transform(frequency_hz, time, force))[:, None]


class LocalField:
    """Pressure in the cells, and the walls."""

    def __init__(self, grid: LocalGrid, time_step_s: float) -> None:
        air = grid.air.astype(float)
        self.pressure, self._before = np.zeros_like(air), np.zeros_like(air)
        reach = SPEED_OF_SOUND_M_PER_S * time_step_s / grid.spacing
        stays = 2.0 * air
        for axis in range(3):
            neighbours = np.roll(air, 1, axis) + np.roll(air, -1, axis)
            stays -= reach[axis] ** 2 * neighbours * air
        self._stays, self._air, self._squares = stays, air, reach**2
        self._cells = np.concatenate([np.zeros(0, dtype=int), *(w.cells for w in grid.walls)])
        counts = [wall.cells.size for wall in grid.walls]
        patches = [
            WallPatch(int(first), count, wall.material, float(grid.spacing[wall.axis]) / 2.0)
            for wall, count, first in zip(
                grid.walls, counts, np.cumsum([0, *counts[:-1]]), strict=True
            )
        ]  # fmt: skip
        self._walls = Walls(patches, time_step_s)
        self._loss = np.repeat([reach[wall.axis] for wall in grid.walls], counts)
        self._change = np.zeros(self._cells.size)

    def advance(self) -> None:
        """One step."""
        flat = self.pressure.reshape(-1)
        pass_walls(flat[self._cells], self._change, self._walls.arguments)
        _step(self.pressure, self._before, self._stays, self._air, *self._squares)
        _take(self._before.reshape(-1), self._cells, self._loss, self._change)
        self.pressure, self._before = self._before, self.pressure


@fast_kernel
def _step(
    now: Any, before: Any, stays: Any, air: Any, x: float, y: float, z: float
) -> None:  # pragma: no cover
    """Pressure a step on, over the one before."""
    for i in range(1, now.shape[0] - 1):
        for j in range(1, now.shape[1] - 1):
            row, old, keep, open_ = now[i, j], before[i, j], stays[i, j], air[i, j]
            left, right, below, above = now[i - 1, j], now[i + 1, j], now[i, j - 1], now[i, j + 1]
            for k in range(1, row.size - 1):
                around = (
                    x * (left[k] + right[k]) + y * (below[k] + above[k])
                    + z * (row[k - 1] + row[k + 1])
                )  # fmt: skip
                old[k] = keep[k] * row[k] - old[k] + open_[k] * around


@fast_kernel
def _take(pressure: Any, cells: Any, loss: Any, change: Any) -> None:  # pragma: no cover
    """What fluxes into walls take from the cells before them; a cell may have several."""
    for n in range(cells.size):
        pressure[cells[n]] -= loss[n] * change[n]
