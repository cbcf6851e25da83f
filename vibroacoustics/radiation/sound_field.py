"""The sound field besides the microphones: measurement surface, map, sphere of directions."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import RIGID_BODY_DOFS, stamp
from ..study.sound_power import DirectivitySettings, MapSettings, SoundPowerSettings
from ..study.study import Study
from .arrangements import (
    check_outside,
    directivity_angles,
    directivity_points,
    map_points,
    reference_box,
    sound_power_points,
)
from .arrays import Array, ComplexArray
from .mirrors import Mirror
from .scene import Scene


@dataclass(frozen=True)
class SoundField:
    """Where the sound field is asked for besides the microphones; nothing by default."""

    sound_power: SoundPowerSettings | None = None
    map: MapSettings | None = None
    directivity: DirectivitySettings | None = None
    line_frequency_hz: tuple[float, ...] = ()
    """Frequencies of map and directivity."""

    @classmethod
    def of_study(cls, study: Study) -> "SoundField":
        """What a study asks for; map and directivity at the first order of its speeds."""
        drawn = study.map is not None or study.directivity is not None
        lines = tuple(map(shaft_frequency_hz, study.operation.speed_rpm)) if drawn else ()
        return cls(study.sound_power, study.map, study.directivity, lines)

    def key_material(self) -> dict[str, Any]:
        """Plain data to be hashed."""
        settings = {
            name: value and value.model_dump()
            for name, value in (
                ("sound_power", self.sound_power),
                ("map", self.map),
                ("directivity", self.directivity),
            )
        }
        return {**settings, "line_frequency_hz": list(self.line_frequency_hz)}


NO_SOUND_FIELD: Final = SoundField()


class Side(Protocol):
    """A machine side: sound pressure of every pattern, in the room of its walls."""

    @property
    def frequency_hz(self) -> Array:
        """Frequencies of the table and, after them, those of the lines."""

    @property
    def walls(self) -> Sequence[Mirror]:
        """Of the room."""

    def clear(self, points: Array) -> NDArray[np.bool_]:
        """Whether pressures at points (point, 3) can be had."""

    def at_points(
        self, points: Array, chosen: slice, name: str, progress: Progress
    ) -> ComplexArray:
        """Pressure at points (point, 3), (point, pattern, frequency), Pa."""


def elsewhere(
    side: Side,
    surroundings: Scene,
    floor_level_m: float,
    sound_field: SoundField,
    tabulated: int,
    progress: Progress,
) -> xr.Dataset:
    """Transfer vectors wherever the sound field is asked for, by the closed-form Green's function.

    The first `tabulated` of the machine side's frequencies are those of the table, the others those
    of the lines.

    Raises
    ------
    ParameterError
        A position of the measurement surface lies in the machine, too close to it or behind a wall.
    """
    floor = next((wall.position_m for wall in side.walls if wall.axis == 2), None)
    table, lines = slice(0, tabulated), slice(tabulated, None)
    parts: dict[str, tuple[ComplexArray, dict[str, Any], str, slice]] = {}
    if sound_field.sound_power is not None:
        points = sound_power_points(sound_field.sound_power, surroundings.machine, floor)
        _check_surface(points, surroundings, side)
        values = _at_points(side, points, table, "sound power", progress)
        distances = ("position", np.linalg.norm(points, axis=1))
        coordinates = {
            "position": np.arange(1, points.shape[0] + 1),
            "position_distance": distances,
        }
        parts["surface_transfer_vector"] = (values, coordinates, "frequency", table)
    if sound_field.map is not None:
        points = map_points(sound_field.map, floor_level_m)
        values = _at_points(side, points, lines, "map", progress)
        parts["map_transfer_vector"] = (values, _map_places(points), "line_frequency", lines)
    if sound_field.directivity is not None:
        points = directivity_points(sound_field.directivity, floor)
        values = _at_points(side, points, lines, "directivity", progress)
        angles = directivity_angles(sound_field.directivity, floor is not None)
        directions = dict(zip(("polar_angle", "azimuth"), angles, strict=True))
        parts["directivity_transfer_vector"] = (values, directions, "line_frequency", lines)
    dataset = xr.Dataset(
        {
            name: stamp(
                name,
                values,
                {**coords, "dof": list(RIGID_BODY_DOFS), dimension: side.frequency_hz[chosen]},
            )
            for name, (values, coords, dimension, chosen) in parts.items()
        }
    )
    if "surface_transfer_vector" in dataset:
        machine = reference_box(surroundings.machine, floor)
        dataset["surface_transfer_vector"].attrs |= {
            "reference_length_m": machine.length_m,
            "reference_width_m": machine.width_m,
            "reference_height_m": machine.height_m,
        }
    return dataset


def _map_places(points: Array) -> dict[str, Any]:
    shape = ("map_row", "map_column")
    indices = {name: np.arange(size) for name, size in zip(shape, points.shape[:2], strict=True)}
    return {**indices, **{f"map_{axis}": (shape, points[..., i]) for i, axis in enumerate("xyz")}}


def _at_points(
    side: Side, points: Array, chosen: slice, name: str, progress: Progress
) -> ComplexArray:
    """Pressures (..., dof, frequency) at points (..., 3); not a number in the box, behind walls."""
    flat = points.reshape(-1, 3)
    dofs, frequencies = len(RIGID_BODY_DOFS), side.frequency_hz[chosen].size
    result = np.full((flat.shape[0], dofs, frequencies), np.nan, dtype=complex)
    clear = np.flatnonzero(side.clear(flat))
    if clear.size:
        result[clear] = side.at_points(flat[clear], chosen, name, progress)[:, :dofs]
    return result.reshape(*points.shape[:-1], dofs, frequencies)


def _check_surface(points: Array, surroundings: Scene, side: Side) -> None:
    wrong = points[~side.clear(points)]
    if wrong.size:
        check_outside("sound_power", wrong[0], surroundings.body)
        raise ParameterError(
            f"sound_power: the position {wrong[0].round(3).tolist()} m about the centre of mass "
            "lies behind a wall or too close to the machine"
        )
