"""Transfer vectors by boundary elements on the meridian: bodies of revolution, floor or none."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...base.errors import ParameterError
from ...base.progress import Progress
from ...machine.shell import Shell
from ..arrays import Array, ComplexArray
from ..exact import box_green
from ..kwave import kwave_version
from ..room_green import check_receiver
from ..room_greens import room_greens
from ..task import Microphones, Task
from .profile import shell_profile
from .receivers import addition, by_images, by_kwave, join_box
from .side import RevolutionSide

_SOLVERS: Final = {
    "k-wave": "boundary elements, k-wave-python {}",
    "closed-form": "boundary elements, image sources",
}


class ByRevolution:
    """Boundary elements on two meshes, and the microphones."""

    def __init__(self, side: RevolutionSide, task: Task) -> None:
        self._side = side
        self._task = task
        _check_receivers(side, task)

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (point, 3) lie off the body and above the floor."""
        return self._side.clear(points)

    def pressures(
        self, elsewhere: Sequence[Microphones], progress: Progress
    ) -> tuple[dict[str, Array | ComplexArray], list[ComplexArray]]:
        """Pressures (receiver, pattern, frequency) and errors; with k-Wave its check besides.

        And pressures (point, pattern, frequency) elsewhere.
        """
        return self._at_receivers(progress), [self._at(asked, progress) for asked in elsewhere]

    def _at_receivers(self, progress: Progress) -> dict[str, Array | ComplexArray]:
        task, side = self._task, self._side
        points = task.receivers.points
        arguments = (points, task.table_hz, "boundary elements", progress)
        if task.settings.room_solver == "closed-form":
            return by_images(side.spectrum(*arguments))
        box = join_box(side, task.settings.room_spacing_m)
        greens = room_greens(box, task, progress)
        expected = [box_green(box, point, task.table_hz, task.scene.walls) for point in points]
        added = addition(side, box, task.table_hz, greens, expected)
        return by_kwave(side.spectrum(*arguments, added), greens, expected)

    def _at(self, asked: Microphones, progress: Progress) -> ComplexArray:
        """Pressures (point, pattern, frequency); those of the table are interpolated."""
        frequency_hz = self._task.frequency_hz[asked.frequencies]
        if asked.frequencies == self._task.table:
            sampled = self._side.spectrum(asked.points, frequency_hz, "sound field", progress)
            pressure = np.moveaxis(sampled.pressure, 0, -1)
        else:
            by_line = [
                self._side.finer_pressures(float(line), asked.points) for line in frequency_hz
            ]
            pressure = np.stack(by_line, axis=-1)
        return pressure[:, : asked.patterns]

    def attributes(self) -> dict[str, Any]:
        """What the result says about its solution."""
        side = self._side
        fine, coarse = (radiator.mesh for radiator in side.radiators)
        return {
            "solver": _SOLVERS[self._task.settings.room_solver].format(kwave_version()),
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
    profile = shell_profile(shell, task.settings.body)
    if profile is None:
        raise ParameterError("radiation.method: revolution needs a body of revolution")
    floor = next((wall.position_m for wall in task.scene.walls), None)
    highest = float(task.frequency_hz.max())
    return ByRevolution(RevolutionSide(profile, task.patterns, highest, floor), task)


def _check_receivers(side: RevolutionSide, task: Task) -> None:
    """Refuse what cannot be computed before anything is computed."""
    box = join_box(side, task.settings.room_spacing_m)
    for name, position in task.positions.items():
        if task.settings.room_solver == "k-wave":
            check_receiver(
                name,
                position,
                box,
                task.settings.room_spacing_m,
                task.scene.walls,
                task.tabulated,
            )
        if not side.clear(position[None, :])[0]:
            raise ParameterError(
                f"receivers.{name}: stands under the floor or on the wall of the machine"
            )
