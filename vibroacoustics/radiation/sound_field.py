"""The sound field besides the microphones: measurement surface, map, sphere of directions."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.errors import ParameterError
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
from .arrays import Array, ComplexArray, IndexArray
from .scene import Scene
from .task import Microphones

Clear = Callable[[Array], NDArray[np.bool_]]
"""Whether a method of radiation has pressures at points (point, 3)."""


@dataclass(frozen=True)
class SoundField:
    """Points of the sound field besides the microphones; nothing by default."""

    sound_power: SoundPowerSettings | None = None
    map: MapSettings | None = None
    directivity: DirectivitySettings | None = None
    line_frequency_hz: tuple[float, ...] = ()
    """Frequencies of map and directivity."""

    @classmethod
    def of_study(cls, study: Study) -> "SoundField":
        """Return the points of a study; map and directivity at the first order of its speeds."""
        has_map = study.map is not None or study.directivity is not None
        lines = tuple(map(shaft_frequency_hz, study.operation.speed_rpm)) if has_map else ()
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


@dataclass(frozen=True)
class FieldPart:
    """Points of the sound field and how their transfer vectors are labelled."""

    name: str
    points: Array
    """(..., 3), m."""
    coordinates: dict[str, Any]
    dimension: str
    """Dimension of the frequencies."""
    frequencies: slice
    clear: IndexArray
    """Those of the points, in one row, at which there are pressures."""

    @property
    def microphones(self) -> Microphones:
        """Points that the method of radiation computes."""
        return Microphones(
            self.points.reshape(-1, 3)[self.clear], self.frequencies, len(RIGID_BODY_DOFS)
        )

    def labelled(self, pressure: ComplexArray, frequency_hz: Array) -> xr.DataArray:
        """Transfer vectors (..., dof, frequency) of the clear points; not a number at the others.

        Parameters
        ----------
        pressure : shape (clear point, dof, frequency), Pa
        frequency_hz : frequencies of the table, then those of the lines, shape (frequency,)
        """
        shape = (self.points.size // 3, *pressure.shape[1:])
        values = np.full(shape, np.nan, dtype=complex)
        values[self.clear] = pressure
        coordinates = {
            **self.coordinates,
            "dof": list(RIGID_BODY_DOFS),
            self.dimension: frequency_hz[self.frequencies],
        }
        by_point = values.reshape(*self.points.shape[:-1], *shape[1:])
        return stamp(self.name, by_point, coordinates)


def field_parts(
    clear: Clear,
    surroundings: Scene,
    floor_level_m: float,
    sound_field: SoundField,
    tabulated: int,
) -> list[FieldPart]:
    """Wherever the sound field is asked for.

    The first `tabulated` of the frequencies are those of the table, the others those of the lines.
    """
    floor = _floor_m(surroundings)
    fields: list[tuple[str, Array, dict[str, Any], str]] = []
    if sound_field.sound_power is not None:
        points = sound_power_points(sound_field.sound_power, surroundings.machine, floor)
        _check_surface(points, surroundings, clear)
        coordinates = {
            "position": np.arange(1, points.shape[0] + 1),
            "position_distance": ("position", np.linalg.norm(points, axis=1)),
        }
        fields.append(("surface_transfer_vector", points, coordinates, "frequency"))
    if sound_field.map is not None:
        points = map_points(sound_field.map, floor_level_m)
        fields.append(("map_transfer_vector", points, _map_positions(points), "line_frequency"))
    if sound_field.directivity is not None:
        points = directivity_points(sound_field.directivity, floor)
        angles = directivity_angles(sound_field.directivity, floor is not None)
        directions = dict(zip(("polar_angle", "azimuth"), angles, strict=True))
        fields.append(("directivity_transfer_vector", points, directions, "line_frequency"))
    chosen = {"frequency": slice(0, tabulated), "line_frequency": slice(tabulated, None)}
    return [
        FieldPart(
            name,
            points,
            coordinates,
            dimension,
            chosen[dimension],
            np.flatnonzero(clear(points.reshape(-1, 3))),
        )
        for name, points, coordinates, dimension in fields
    ]


def labelled_fields(
    parts: Sequence[FieldPart],
    pressures: Sequence[ComplexArray],
    frequency_hz: Array,
    surroundings: Scene,
) -> xr.Dataset:
    """Transfer vectors of the parts of the sound field, from their pressures (see `FieldPart`)."""
    dataset = xr.Dataset(
        {
            part.name: part.labelled(pressure, frequency_hz)
            for part, pressure in zip(parts, pressures, strict=True)
        }
    )
    if "surface_transfer_vector" in dataset:
        machine = reference_box(surroundings.machine, _floor_m(surroundings))
        dataset["surface_transfer_vector"].attrs |= {
            "reference_length_m": machine.length_m,
            "reference_width_m": machine.width_m,
            "reference_height_m": machine.height_m,
        }
    return dataset


def _floor_m(surroundings: Scene) -> float | None:
    return next((wall.position_m for wall in surroundings.walls if wall.axis == 2), None)


def _map_positions(points: Array) -> dict[str, Any]:
    shape = ("map_row", "map_column")
    indices = {name: np.arange(size) for name, size in zip(shape, points.shape[:2], strict=True)}
    return {**indices, **{f"map_{axis}": (shape, points[..., i]) for i, axis in enumerate("xyz")}}


def _check_surface(points: Array, surroundings: Scene, clear: Clear) -> None:
    wrong = points[~clear(points)]
    if wrong.size:
        check_outside("sound_power", wrong[0], surroundings.body)
        raise ParameterError(
            f"sound_power: the position {wrong[0].round(3).tolist()} m about the centre of mass "
            "lies behind a wall or too close to the machine"
        )
