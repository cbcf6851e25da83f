"""All patterns of a body of revolution on two meshes, at every tabulated frequency."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import Final

import numpy as np
import psutil
from numpy.typing import NDArray

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ...base.errors import ParameterError
from ...base.forms import returned
from ...base.pieces import stored
from ...base.processes import distributed
from ...base.progress import Progress, no_progress
from ...base.revolution import Profile
from ...base.threads import in_threads, mapped_in_threads, processors
from ..arrays import Array, ComplexArray, IndexArray
from ..patterns import Pattern
from .mesh import mesh
from .profile import above_floor, with_fewer_points
from .radiator import Radiator, WallPressure
from .sampling import AtFrequency, Sampled, first_solved, interpolated, sample

_ELEMENTS: Final = 20
"""Least number of elements on the meridian."""
_ELEMENTS_PER_WAVE: Final = 1.5
_GRADINGS: Final = 2
_COARSENING: Final = 1.25
_ERROR: Final = 0.75
"""Estimated error of the finer mesh over the difference of both, which is the coarser one's."""
_QUADRATURE: Final = 3e-8
"""Error of the rules that both meshes share, over the largest pressure."""
_CLOSEST_M: Final = 1e-3
"""Least distance from the wall to points with pressures."""
_SOLVED: Final = 3
"""Times as many as at first are solved in all, about; how many is not known before."""
_FREQUENCIES: Final = 200
"""Whose wall pressures memory is reckoned with."""

Addition = Callable[[int], ComplexArray]
"""Function of the index of a tabulated frequency to the addition to pressures, (point, pattern)."""


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
        longest = min(length / _ELEMENTS, wave / _ELEMENTS_PER_WAVE)
        self.longest_m = longest
        self.floor_z_m = floor_z_m
        self.finer = Radiator(mesh(meridian, longest, _GRADINGS), patterns, floor_z_m)
        coarser = with_fewer_points(meridian, longest)
        self._coarser = mesh(coarser, _COARSENING * longest, _GRADINGS - 1)
        self._patterns = patterns
        _check_memory(self.finer)
        heights = self.finer.mesh.points[:, 1]
        self._middle_z_m = float(heights.min() + heights.max()) / 2.0
        self._solved: dict[float, list[WallPressure]] = {}

    def __getstate__(self) -> dict[str, object]:
        """Return what goes to other processes: nothing that is solved."""
        return {**self.__dict__, "_solved": {}}

    @cached_property
    def radiators(self) -> list[Radiator]:
        """Radiators on the finer mesh and on the coarser one."""
        return [self.finer, Radiator(self._coarser, self._patterns, self.floor_z_m)]

    @property
    def solved_frequencies(self) -> int:
        """Number of frequencies solved so far."""
        return len(self._solved)

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (point, 3) lie off the body and above the floor."""
        meridian = np.stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]], axis=1)
        free = self.finer.mesh.depth_m(meridian) < -_CLOSEST_M
        if self.floor_z_m is not None:
            free &= points[:, 2] > self.floor_z_m - 1e-9
        return free

    def pressures(self, frequency_hz: float, points: Array) -> tuple[ComplexArray, Array]:
        """Pressure at points (point, 3) and its estimated error, (point, pattern), Pa."""
        fine, coarse = (
            radiator.pressures(wall, points)
            for radiator, wall in zip(self.radiators, self._walls(frequency_hz), strict=True)
        )
        return fine, error_of(fine, coarse)

    def finer_pressures(self, frequency_hz: float, points: Array) -> ComplexArray:
        """Pressure at points (point, 3), (point, pattern), Pa."""
        return self.radiators[0].pressures(self._walls(frequency_hz)[0], points)

    def added(self, frequency_hz: float, by_wall: AtFrequency) -> ComplexArray:
        """Return the further pressure by the finer mesh's wall, (point, pattern), Pa."""
        return by_wall(self.radiators[0], self._walls(frequency_hz)[0])

    def _walls(self, frequency_hz: float) -> list[WallPressure]:
        if frequency_hz not in self._solved:
            self._solved[frequency_hz] = [
                radiator.solve(frequency_hz) for radiator in self.radiators
            ]
        return self._solved[frequency_hz]

    def spectrum(
        self,
        points: Array,
        table_hz: Array,
        name: str = "boundary elements",
        progress: Progress = no_progress,
        addition: Addition | None = None,
    ) -> Sampled:
        """Pressures at points (point, 3) at evenly spaced frequencies, with an addition to them."""
        delay_s, done = self.delays_s(points), 0
        expected = min(_SOLVED * first_solved(table_hz).size, table_hz.size)

        def solved(index: int) -> tuple[list[WallPressure], ComplexArray, Array]:
            hertz = float(table_hz[index])
            pressure, error = self.pressures(hertz, points)
            total = pressure if addition is None else pressure + addition(index)
            return self._walls(hertz), total, error

        def solve(indices: IndexArray) -> tuple[ComplexArray, Array]:
            nonlocal done
            total, parts = max(expected, done + indices.size), []
            solving = partial(distributed, solved, otherwise=mapped_in_threads)
            form = returned(solved)
            for walls, *part in stored((name, points, table_hz), indices.tolist(), solving, form):
                self._solved[walls[0].frequency_hz] = walls  # of another process
                parts.append(part)
                done += 1
                progress(name, min(done, total - 1), total)
            pressure, error = zip(*parts, strict=True)
            return np.array(pressure), np.array(error)

        progress(name, 0, expected)
        sampled = sample(table_hz, delay_s, solve)
        progress(name, done, done)
        return sampled

    def with_small(
        self,
        pressure: Sampled,
        addition: Addition,
        points: Array,
        table_hz: Array,
        name: str,
        progress: Progress,
    ) -> Sampled:
        """Add to pressures at points (point, 3) what is small beside them: few frequencies do.

        Parameters
        ----------
        pressure : result of `spectrum`
        addition : to them
        points, table_hz : points, shape (point, 3), and frequencies, shape (frequency,), of the
            pressures
        name, progress : name and progress of the computation
        """
        indices = first_solved(table_hz)
        progress(name, 0, indices.size)
        added = np.array(in_threads([partial(addition, int(index)) for index in indices]))
        progress(name, indices.size, indices.size)
        everywhere = interpolated(table_hz, self.delays_s(points), indices, added)
        return replace(
            pressure,
            pressure=pressure.pressure + everywhere.pressure,
            error=pressure.error + everywhere.error,
        )

    def delays_s(self, points: Array) -> Array:
        """Travel time to points (point, 3), the mean of that from the body and from its image."""
        middles = [self._middle_z_m]
        if self.floor_z_m is not None:
            middles.append(2.0 * self.floor_z_m - self._middle_z_m)
        distances = [np.linalg.norm(points - [0.0, 0.0, z], axis=1) for z in middles]
        return np.asarray(np.mean(distances, axis=0) / SPEED_OF_SOUND_M_PER_S)


def error_of(fine: ComplexArray, coarse: ComplexArray) -> Array:
    """Estimated error of the finer mesh's pressures (point, pattern)."""
    size = np.abs(fine).max(axis=0, initial=0.0)
    return np.asarray(_ERROR * np.abs(fine - coarse) + _QUADRATURE * size)


def memory_bytes(radiator: Radiator) -> float:
    """Memory that the finer mesh takes at its peak, solved in as many threads as processors."""
    nodes = len(radiator.mesh.points)
    layers = 2.0 * radiator.orders * 1.2 * nodes**2
    return 16.0 * (
        processors() * (layers + 4.0 * nodes**2) + _FREQUENCIES * radiator.columns * nodes
    )


def _check_memory(radiator: Radiator) -> None:
    """Refuse meshes that do not fit."""
    needed, available = memory_bytes(radiator), float(psutil.virtual_memory().available)
    if needed > available:
        raise ParameterError(
            f"radiation.maximum_frequency_hz: boundary elements with {len(radiator.mesh.points)} "
            f"nodes and {radiator.orders} orders need {needed / 2**30:.3g} GiB, "
            f"{available / 2**30:.3g} GiB are available"
        )
