"""Transfer vectors by boundary elements on the meridian: bodies of revolution, floor or none."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...base.errors import ParameterError
from ...base.progress import Progress
from ...machine.shell import Shell
from ..arrays import Array, ComplexArray
from ..box import Box, BoxField, closed_box
from ..room_greens import (
    Vectors,
    check_receivers,
    closed_greens,
    differences_db,
    room_greens,
    solver,
    with_kwave,
)
from ..task import Microphones, Task
from .profile import body_profile
from .sampling import Sampled, over_ground
from .side import Addition, RevolutionSide

_NAME: Final = "boundary elements"
_ON_BOX: Final = "boundary elements at the box of k-Wave"
_BOX_MARGIN_M: Final = 0.04
"""Distance from the body to its box."""


class ByRevolution:
    """Boundary elements on two meshes, and the microphones."""

    def __init__(self, side: RevolutionSide, task: Task) -> None:
        self.side = side
        self._task = task
        _check_receivers(side, task)

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (point, 3) lie off the body and above the floor."""
        return self.side.clear(points)

    def pressures(
        self, elsewhere: Sequence[Microphones], progress: Progress
    ) -> tuple[Vectors, list[ComplexArray]]:
        """Pressures (receiver, pattern, frequency) and errors; with k-Wave its check besides.

        And pressures (point, pattern, frequency) elsewhere.
        """
        return self._at_receivers(progress), [
            self._at(microphones, progress) for microphones in elsewhere
        ]

    def _at_receivers(self, progress: Progress) -> Vectors:
        task, side = self._task, self.side
        points, table_hz = task.receivers.points, task.table_hz
        over_ground = self._over_ground(points, table_hz)
        closed = side.spectrum(points, table_hz, _NAME, progress, over_ground)
        if not task.kwave:
            return by_name(closed)
        box = join_box(side, task.resolving_spacing_m)
        greens, expected = room_greens(box, task, progress), list(closed_greens(box, task))
        microphones = task.kwave_microphones
        table_hz = task.frequency_hz[microphones.frequencies]
        added = addition(side, box, table_hz, greens, expected)
        exact = closed.selected(microphones.frequencies, task.kwave_rows)
        kwave = side.with_small(exact, added, microphones.points, table_hz, _ON_BOX, progress)
        differences = differences_db(greens, iter(expected))
        return with_kwave(task, by_name(closed), by_name(kwave), differences)

    def _at(self, microphones: Microphones, progress: Progress) -> ComplexArray:
        """Pressures (point, pattern, frequency); those of the table are interpolated."""
        frequency_hz = self._task.frequency_hz[microphones.frequencies]
        added = self._over_ground(microphones.points, frequency_hz)
        if microphones.frequencies == self._task.table:
            side, name = self.side, "sound field"
            sampled = side.spectrum(microphones.points, frequency_hz, name, progress, added)
            pressure = np.moveaxis(sampled.pressure, 0, -1)
        else:
            by_line = [
                self.side.finer_pressures(float(line), microphones.points) for line in frequency_hz
            ]
            if added is not None:
                by_line = [values + added(number) for number, values in enumerate(by_line)]
            pressure = np.stack(by_line, axis=-1)
        return pressure[:, : microphones.patterns]

    def _over_ground(self, points: Array, frequency_hz: Array) -> Addition | None:
        """Addition of ground and barrier at points, by index of the frequency; none on a floor."""
        by_wall = over_ground(self._task.scene, points)
        if by_wall is None:
            return None
        return lambda index: self.side.added(float(frequency_hz[index]), by_wall)

    def attributes(self) -> dict[str, Any]:
        """Return attributes of the result on its solution."""
        side = self.side
        fine, coarse = (radiator.mesh for radiator in side.radiators)
        return {
            "solver": solver(self._task),
            "boundary_elements": f"{len(fine.lengths)}, coarser {len(coarse.lengths)}",
            "boundary_element_longest_m": float(fine.lengths.max()),
            "boundary_element_shortest_m": float(fine.lengths.min()),
            "orders_around": f"0 to {side.radiators[0].orders - 1}",
            "frequencies_solved": f"{side.solved_frequencies} of {self._task.frequency_hz.size}",
            "neglected": "the air's load on the shell, absorption in the air",
        }


def by_revolution(shell: Shell, task: Task) -> ByRevolution:
    """The method for a study's shell or sphere.

    Raises
    ------
    ParameterError
        A receiver lies on the wall, under the floor or, with k-Wave, too close; memory does not
        suffice; the body is no body of revolution.
    """
    profile = body_profile(shell, task.settings.body)
    if profile is None:
        raise ParameterError("radiation.method: revolution needs a body of revolution")
    floor = next((wall.position_m for wall in task.scene.walls), None)
    highest = float(task.frequency_hz.max())
    return ByRevolution(RevolutionSide(profile, task.patterns, highest, floor), task)


def _check_receivers(side: RevolutionSide, task: Task) -> None:
    """Refuse what cannot be computed before anything is computed."""
    if task.kwave:
        check_receivers(join_box(side, task.resolving_spacing_m), task)
    for name, position in task.positions.items():
        if not side.clear(position[None, :])[0]:
            raise ParameterError(
                f"receivers.{name}: is under the floor or on the wall of the machine"
            )


def join_box(side: RevolutionSide, spacing_m: float) -> Box:
    """Box around the body in cells of at most a spacing; it stands on a floor."""
    nodes = side.radiators[0].mesh.points
    reach = float(nodes[:, 0].max()) + _BOX_MARGIN_M
    lower = np.array([-reach, -reach, float(nodes[:, 1].min()) - _BOX_MARGIN_M])
    upper = np.array([reach, reach, float(nodes[:, 1].max()) + _BOX_MARGIN_M])
    if side.floor_z_m is not None:
        lower[2] = side.floor_z_m
    cells = np.maximum(2, np.ceil((upper - lower) / spacing_m).astype(int))
    edges = [
        low + (high - low) / count * np.arange(-1, count + 2)
        for low, high, count in zip(lower, upper, cells, strict=True)
    ]
    on_floor = [] if side.floor_z_m is None else [(2, -1)]
    return closed_box(edges, [1, 1, 1], [count + 1 for count in cells], on_floor)


def by_name(sampled: Sampled) -> Vectors:
    """Pressures and errors, (receiver, pattern, frequency)."""
    return {
        "transfer_vector": np.moveaxis(sampled.pressure, 0, -1),
        "transfer_vector_error": np.moveaxis(sampled.error, 0, -1),
    }


def addition(
    side: RevolutionSide,
    box: Box,
    table_hz: Array,
    greens: Sequence[BoxField],
    expected: Sequence[BoxField],
) -> Addition:
    """Return what k-Wave's Green's functions add to each microphone's pressure at a frequency."""
    points = np.concatenate([box.inner, box.outer])
    pairs = len(box.inner)
    couples = list(zip(greens, expected, strict=True))
    inner = box.weights * np.array([green.inner - exact.inner for green, exact in couples])
    outer = box.weights * np.array([green.outer - exact.outer for green, exact in couples])

    def pressure_added(index: int) -> ComplexArray:
        pressure = side.finer_pressures(float(table_hz[index]), points)
        added: ComplexArray = outer[:, index] @ pressure[:pairs]
        added -= inner[:, index] @ pressure[pairs:]
        return added

    return pressure_added
