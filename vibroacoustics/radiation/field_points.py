"""Transfer vectors from a body of revolution to any points, at any frequencies."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.forms import returned
from ..base.pieces import stored
from ..base.threads import mapped_in_threads
from ..base.vocabulary import RIGID_BODY_DOFS
from ..study.radiation import RadiationSettings
from ..study.study import Study
from .arrays import Array, ComplexArray
from .interpolation import Interpolant
from .patterns import SurfaceMotion
from .revolution.method import by_revolution
from .revolution.sampling import over_ground
from .sound_field import SoundField
from .transfer_vectors import cache_key_material, labelled, task_of


def vectors_at(
    study: Study,
    motions: Sequence[SurfaceMotion],
    points: Mapping[str, Array],
    frequency_hz: Array,
) -> xr.Dataset:
    """Compute pressure per velocity at points by boundary elements, without those in the body.

    Over the floor in closed form, as at the microphones that k-Wave does not compute; the body
    must be one of revolution.

    Parameters
    ----------
    study : with the shell and the settings of the radiation
    motions : modes of the shell
    points : by name, shape (3,), m
    frequency_hz : rising, shape (frequency,)

    Returns
    -------
    `transfer_vector` and, of modes, `pattern_transfer_vector`, the points as receivers
    """
    shell = study.machine.shell
    task = task_of(shell, {}, _closed(study), motions=motions)
    side = by_revolution(shell, task).side
    clear = {name: point for name, point in points.items() if side.clear(point[None])[0]}
    positions, radiator = np.array(list(clear.values())), side.finer
    ground = over_ground(task.scene, positions)

    def pressure(hertz: float) -> ComplexArray:
        wall = radiator.solve(hertz)
        direct = radiator.pressures(wall, positions)
        return direct if ground is None else direct + ground(radiator, wall)

    in_parallel = partial(mapped_in_threads, pressure)
    solved = list(
        stored("pressure at points", frequency_hz.tolist(), in_parallel, returned(pressure))
    )
    names = [pattern.name for pattern in task.patterns[len(RIGID_BODY_DOFS) :]]
    vectors = {"transfer_vector": np.stack(solved, axis=-1)}
    return labelled(vectors, clear, frequency_hz, names)


def key_at(
    study: Study,
    motions: Sequence[SurfaceMotion],
    points: Mapping[str, Array],
    frequency_hz: Array,
) -> dict[str, Any]:
    """Return all that shapes the result of `vectors_at`, as plain data to be hashed."""
    lines = SoundField(line_frequency_hz=tuple(frequency_hz.tolist()))
    key = cache_key_material(study.machine.shell, {}, _closed(study), lines, motions)
    return {**key, "points": {name: point.tolist() for name, point in points.items()}}


def within(
    vectors: Interpolant, edges_hz: Sequence[tuple[float, float]]
) -> Callable[[NDArray[np.float64]], NDArray[np.complex128]]:
    """Return transfer vectors in some bands; silence outside.

    Parameters
    ----------
    vectors : in these bands
    edges_hz : lower and upper one of each band
    """
    lower, upper = np.array(edges_hz, dtype=np.float64).T

    def in_bands(frequency_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
        hertz = frequency_hz[:, None]
        held = ((hertz >= lower) & (hertz < upper)).any(axis=1)
        some = vectors(frequency_hz[held] if held.any() else lower[:1])
        every = np.zeros((*some.shape[:-1], frequency_hz.size), dtype=complex)
        every[..., held] = some[..., : int(held.sum())]
        return every

    return in_bands


def _closed(study: Study) -> RadiationSettings:
    return study.radiation.model_copy(update={"room_solver": "closed-form"})
