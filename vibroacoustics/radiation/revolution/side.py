"""All patterns of a body of revolution on two meshes, at every tabulated frequency."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ...base.progress import Progress, no_progress
from ..arrays import Array, ComplexArray, IndexArray
from ..machine_side import in_threads
from ..patterns import Pattern
from .mesh import mesh
from .profile import Profile, above_floor
from .radiator import Radiator, WallPressure
from .sampling import Sampled, sample

ELEMENTS: Final = 20
"""On the meridian, at least."""
ELEMENTS_PER_WAVE: Final = 1.5
GRADINGS: Final = 2
_COARSENING: Final = 1.25
_ERROR: Final = 1.2
"""Error of the finer mesh over the difference of both, which is the coarser one's: measured."""


class RevolutionSide:
    """A body of revolution in free field or over a hard floor.

    Parameters
    ----------
    profile : its meridian
    patterns : velocities of its wall
    maximum_frequency_hz : that the meshes resolve
    floor_z_m : height of a hard floor
    """

    def __init__(
        self,
        profile: Profile,
        patterns: Sequence[Pattern],
        maximum_frequency_hz: float,
        floor_z_m: float | None = None,
    ) -> None:
        meridian = above_floor(profile, floor_z_m)
        length = float(mesh(meridian, 1e3, 0).lengths.sum())
        wave = SPEED_OF_SOUND_M_PER_S / maximum_frequency_hz
        longest = min(length / ELEMENTS, wave / ELEMENTS_PER_WAVE)
        meshes = [
            mesh(meridian, longest, GRADINGS),
            mesh(meridian, _COARSENING * longest, GRADINGS - 1),
        ]
        self.radiators = [Radiator(one, patterns, floor_z_m) for one in meshes]
        self.floor_z_m = floor_z_m
        heights = meshes[0].points[:, 1]
        self._middle_z_m = float(heights.min() + heights.max()) / 2.0
        self._solved: dict[float, list[WallPressure]] = {}

    def pressures(self, frequency_hz: float, points: Array) -> tuple[ComplexArray, Array]:
        """Pressure at points (point, 3) and its estimated error, (point, pattern), Pa."""
        if frequency_hz not in self._solved:
            self._solved[frequency_hz] = [one.solve(frequency_hz) for one in self.radiators]
        fine, coarse = (
            radiator.pressures(wall, points)
            for radiator, wall in zip(self.radiators, self._solved[frequency_hz], strict=True)
        )
        return fine, _ERROR * np.abs(fine - coarse)

    def spectrum(
        self,
        points: Array,
        table_hz: Array,
        name: str = "boundary elements",
        progress: Progress = no_progress,
    ) -> Sampled:
        """Pressures at points (point, 3) at evenly spaced frequencies, (frequency, point, pattern)."""

        def solve(indices: IndexArray) -> tuple[ComplexArray, Array]:
            tasks: list[Callable[[], tuple[ComplexArray, Array]]] = [
                partial(self.pressures, float(table_hz[index]), points) for index in indices
            ]
            progress(name, int(indices[0]), table_hz.size)
            pressure, error = zip(*in_threads(tasks), strict=True)
            return np.array(pressure), np.array(error)

        sampled = sample(table_hz, self.delays_s(points), solve)
        progress(name, table_hz.size, table_hz.size)
        return sampled

    def delays_s(self, points: Array) -> Array:
        """Travel time from the body to points (point, 3), the mean of the body's and its image's."""
        middles = [self._middle_z_m]
        if self.floor_z_m is not None:
            middles.append(2.0 * self.floor_z_m - self._middle_z_m)
        distances = [np.linalg.norm(points - [0.0, 0.0, z], axis=1) for z in middles]
        delay: Array = np.mean(distances, axis=0) / SPEED_OF_SOUND_M_PER_S
        return delay
