"""Points about the machine for sound power, map and directivity.

ISO 3744:2010, Annex B (hemisphere) and Annex C (parallelepiped), as understood from secondary
sources; the standard itself was not at hand. Table B.1 is as in the MIT-licensed phonometry: every
position lies on the unit sphere to its two digits, and the second ten are the first ten turned by
60° about z. (By 180° are turned the second ten of Table B.2, for sources without tones.) The rule
of Annex C is that of its adoption GOST R ISO 3744-2013, which names the middles of the partial
areas, with the corners besides that ISO 3744:1994, Annex C, names too.
"""

from collections.abc import Sequence
from math import ceil
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.errors import ParameterError
from ..study.sound_power import (
    HEMISPHERES,
    DirectivitySettings,
    MapSettings,
    SoundPowerSettings,
)
from .arrays import Array
from .bodies import Body

TABLE_B1: Final = np.array(
    [
        (0.16, -0.96, 0.22), (0.78, -0.60, 0.20), (0.78, 0.55, 0.31), (0.16, 0.90, 0.41),
        (-0.83, 0.32, 0.45), (-0.83, -0.40, 0.38), (-0.26, -0.65, 0.71), (0.74, -0.07, 0.67),
        (-0.26, 0.50, 0.83), (0.10, -0.10, 0.99),
        (0.91, -0.34, 0.22), (0.91, 0.38, 0.20), (-0.09, 0.95, 0.31), (-0.70, 0.59, 0.41),
        (-0.69, -0.56, 0.45), (-0.07, -0.92, 0.38), (0.43, -0.55, 0.71), (0.43, 0.61, 0.67),
        (-0.56, 0.02, 0.83), (0.14, 0.04, 0.99),
    ]
)  # fmt: skip
"""(x/r, y/r, z/r) of positions 1 to 20, for sources that may emit tones; origin on the floor."""

LARGEST_PART: Final = 3.0
"""Longest side of a partial area of the box, in measurement distances (C.1)."""


class ReferenceBox(NamedTuple):
    """Smallest box that stands on the floor and encloses the machine (3.11)."""

    origin_m: Array
    """Middle of its footprint, on the floor, (3,)."""
    length_m: float
    """Length along x."""
    width_m: float
    """Width along y."""
    height_m: float

    @property
    def characteristic_dimension_m(self) -> float:
        """d0, half the diagonal of the box with its image in the floor (3.12)."""
        return float(np.linalg.norm([self.length_m / 2.0, self.width_m / 2.0, self.height_m]))


def reference_box(body: Body, floor_z_m: float | None) -> ReferenceBox:
    """The box of ISO 3744 about a body.

    Raises
    ------
    ParameterError
        There is no floor.
    """
    if floor_z_m is None:
        raise ParameterError("sound_power: needs a hard floor; ISO 3744 knows no free field")
    lower, upper = body.bounds()
    middle = (lower + upper) / 2.0
    length, width, _ = (float(edge) for edge in upper - lower)
    origin = np.array([middle[0], middle[1], floor_z_m])
    return ReferenceBox(origin, length, width, float(upper[2] - floor_z_m))


def sound_power_points(settings: SoundPowerSettings, body: Body, floor_z_m: float | None) -> Array:
    """Positions (position, 3) of a study's arrangement in the machine's coordinates, m.

    Raises
    ------
    ParameterError
        There is no floor, or the hemisphere's radius is below twice the characteristic dimension
        of the source (7.2.3).
    """
    box = reference_box(body, floor_z_m)
    if settings.arrangement not in HEMISPHERES:
        edges = (box.length_m, box.width_m, box.height_m)
        return box.origin_m + box_positions(*edges, settings.distance_m)
    least = 2.0 * box.characteristic_dimension_m
    if settings.radius_m < least:
        raise ParameterError(
            f"sound_power.radius_mm = {1e3 * settings.radius_m:g} mm: must be at least twice the "
            f"characteristic dimension of the machine, {1e3 * least:.0f} mm (ISO 3744, 7.2.3)"
        )
    count = int(settings.arrangement.rpartition("-")[2])
    return box.origin_m + hemisphere_positions(settings.radius_m, count)


def hemisphere_positions(radius_m: float, count: int = 10) -> Array:
    """The first `count` positions of Table B.1, (position, 3), from the origin on the floor."""
    return np.asarray(radius_m * TABLE_B1[:count])


def box_positions(length_m: float, width_m: float, height_m: float, distance_m: float) -> Array:
    """Positions (position, 3) on the parallelepiped about a reference box, origin on the floor.

    Each of its five sides is cut into the fewest equal rectangles no longer than three measurement
    distances; microphones are in the middle of each and at their corners, those on the floor left
    out. A small machine gets nine: five sides and the four upper corners. EN 12102-1 takes the free
    field over a reflecting plane from ISO 3744; it is taken here to be this box at 1 m, as
    understood from its scope and table of contents: the standard was not at hand.
    """
    half_length, half_width = length_m / 2.0 + distance_m, width_m / 2.0 + distance_m
    lower = np.array([-half_length, -half_width, 0.0])
    upper = np.array([half_length, half_width, height_m + distance_m])
    sides = [(0, lower), (0, upper), (1, lower), (1, upper), (2, upper)]
    points = [
        _side_positions(axis, corner[axis], lower, upper, LARGEST_PART * distance_m)
        for axis, corner in sides
    ]
    above = [point for point in np.concatenate(points) if point[2] > 1e-9]
    return np.asarray(np.unique(np.round(above, 9), axis=0))


def _side_positions(
    axis: int, coordinate: float, lower: Array, upper: Array, longest: float
) -> Array:
    """Middles and corners of the partial areas of one side, (position, 3)."""
    counts = [ceil((high - low) / longest - 1e-9) for low, high in zip(lower, upper, strict=True)]
    corners = [np.linspace(lower[i], upper[i], counts[i] + 1) for i in range(3)]
    middles = [(line[1:] + line[:-1]) / 2.0 for line in corners]
    corners[axis] = middles[axis] = np.array([coordinate])
    return np.concatenate([_grid(middles), _grid(corners)])


def _grid(lines: Sequence[Array]) -> Array:
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)


def map_points(settings: MapSettings, floor_level_m: float) -> Array:
    """Points of a map (row, column, 3) in the machine's coordinates, m.

    Parameters
    ----------
    settings : the plane; its heights count from the floor's level
    floor_level_m : vertical coordinate of that level
    """
    across, up = (
        np.linspace(*span, size + 1)
        for span, size in zip(
            (settings.horizontal_m, settings.vertical_m), settings.sizes, strict=True
        )
    )
    rows, columns = np.meshgrid(up, across, indexing="ij")
    order = {"x": (2, 0, 1), "y": (0, 2, 1), "z": (0, 1, 2)}[settings.normal]
    planes = (columns, rows, np.full_like(rows, settings.coordinate_m))
    points: Array = np.stack([planes[i] for i in order], axis=-1)
    points[..., 2] += floor_level_m
    return points


def directivity_angles(settings: DirectivitySettings, on_floor: bool) -> tuple[Array, Array]:
    """Polar angles from +z, down to the floor or right round, and azimuths from +x, rad."""
    quarter = round(np.pi / 2.0 / settings.step_rad)
    polar = np.linspace(0.0, np.pi / 2.0, quarter + 1)
    if not on_floor:
        polar = np.linspace(0.0, np.pi, 2 * quarter + 1)
    return polar, np.linspace(0.0, 2.0 * np.pi, 4 * quarter, endpoint=False)


def directivity_points(settings: DirectivitySettings, floor_z_m: float | None) -> Array:
    """Points (polar angle, azimuth, 3) about the shaft's axis in the machine's coordinates, m.

    The centre is the foot of the axis on the floor, or the centre of mass in free field.
    """
    polar, azimuth = directivity_angles(settings, floor_z_m is not None)
    theta, phi = np.meshgrid(polar, azimuth, indexing="ij")
    sine = np.sin(theta)
    direction = np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=-1)
    points: Array = settings.radius_m * direction
    points[..., 2] += floor_z_m or 0.0
    return points


def check_outside(name: str, points: Array, body: Body) -> None:
    """Refuse points (..., 3) inside the body."""
    contained = [body.contains(point) for point in points.reshape(-1, 3)]
    _refuse(name, points, np.reshape(contained, points.shape[:-1]), "inside the machine")


def _refuse(name: str, points: Array, wrong: NDArray[np.bool_], where: str) -> None:
    if wrong.any():
        x, y, z = 1e3 * points[wrong][0]
        raise ParameterError(
            f"{name}: point x, y, z = {x:.0f}, {y:.0f}, {z:.0f} mm from the centre of mass lies "
            f"{where}"
        )
