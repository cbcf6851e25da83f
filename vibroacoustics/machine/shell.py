"""The compressor's shell as a sound radiator."""

from collections.abc import Iterator
from math import hypot
from typing import Annotated, ClassVar, Final, NamedTuple

import numpy as np
from pydantic import Field

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.parameters import Contradictions, Held, Parameters
from ..base.revolution import Point, Profile, shell_profile

FEWEST: Final = 3
MOST: Final = 200
"""Each line between points costs the radiation one element or more."""
_LEAST_LINE_M: Final = 1e-4
_TOUCHING_M: Final = 1e-5
_RADIUS_M: Final = (0.01, 1.0)
_HEIGHT_M: Final = (0.02, 3.0)


def why_no_body(points: tuple[Point, ...]) -> Iterator[str]:
    """Give what is wrong with the points of a profile, in the order in which it matters.

    Parameters
    ----------
    points : radius and height above the lowest of them, m
    """
    if not FEWEST <= len(points) <= MOST:
        yield f"{len(points)} points; allowed from {FEWEST} to {MOST}"
        return
    corners = np.array(points)
    (radius, height), leftmost = corners.T, int(np.argmin(corners[:, 0]))
    if radius[leftmost] < 0.0:
        yield (
            f"point {leftmost + 1} = {_shown(corners[leftmost])} mm: the radius must not be "
            "negative"
        )
    for end, word in ((0, "first"), (-1, "last")):
        if radius[end] != 0.0:
            yield (
                f"{word} point = {_shown(corners[end])} mm: must be on the axis, at radius 0, so "
                "that the body is closed"
            )
    if not height[0] < height[-1]:
        yield (
            f"runs from {1e3 * height[0]:g} to {1e3 * height[-1]:g} mm on the axis: must run from "
            "its bottom to its top"
        )
    if height.min() != 0.0:
        yield f"lowest height = {1e3 * height.min():g} mm: must be 0, heights count from there"
    yield from _out_of_range(radius, height)
    yield from _crossings(corners)


def _out_of_range(radius: Array, height: Array) -> Iterator[str]:
    for name, value, (least, most) in (
        ("radius", radius.max(), _RADIUS_M),
        ("height", height.max(), _HEIGHT_M),
    ):
        if not least <= value <= most:
            yield (
                f"largest {name} = {1e3 * value:g} mm: allowed from {1e3 * least:g} to "
                f"{1e3 * most:g} mm"
            )


def _crossings(corners: Array) -> Iterator[str]:
    """Give lines that are too short, meet the axis, each other, or lead back on themselves."""
    step = np.diff(corners, axis=0)
    length = np.linalg.norm(step, axis=1)
    short = int(np.argmin(length))
    if length[short] < _LEAST_LINE_M:
        yield (
            f"points {short + 1} and {short + 2}: {1e3 * length[short]:.3g} mm apart; at least "
            f"{1e3 * _LEAST_LINE_M:g} mm are needed"
        )
        return
    inner = np.flatnonzero(corners[1:-1, 0] < _TOUCHING_M)
    if inner.size:
        yield (
            f"point {inner[0] + 2} = {_shown(corners[inner[0] + 1])} mm: the profile crosses "
            "itself on the axis, where only its first and last point may be"
        )
    lines = np.argwhere(_meet(corners, step))
    if lines.size:
        first, second = lines[0] + 1
        yield (
            f"the lines after point {first} and after point {second} cross or touch: a profile "
            "must not cross itself"
        )


def _meet(corners: Array, step: Array) -> Array:
    """Whether two lines have more than their common end in common, shape (line, line)."""
    ahead = corners[None, :] - corners[:-1, None]
    share = np.sum(ahead * step[:, None], axis=2) / np.sum(step**2, axis=1)[:, None]
    nearest = np.clip(share, 0.0, 1.0)[..., None] * step[:, None]
    line, point = np.ogrid[: len(step), : len(corners)]
    touches = np.linalg.norm(ahead - nearest, axis=2) < _TOUCHING_M
    touches &= (point != line) & (point != line + 1)
    side = step[:, None, 0] * ahead[..., 1] - step[:, None, 1] * ahead[..., 0]
    parts = side[:, :-1] * side[:, 1:] < 0.0
    by_point = touches[:, :-1] | touches[:, 1:]
    beside = np.abs(np.subtract.outer(np.arange(len(step)), np.arange(len(step)))) > 1
    return np.asarray(np.triu((parts & parts.T & beside) | by_point | by_point.T))


def _shown(point: Array) -> str:
    return f"[{1e3 * point[0]:g}, {1e3 * point[1]:g}]"


OUTSIDE: Final = Held("give the outside of the shell: each value needs a radiation of its own")
_SIZE: Final = "outer_diameter_mm and height_mm of a cylinder, or profile_mm"


class Cylinder(NamedTuple):
    """Size of a cylinder with flat or domed caps, m."""

    radius_m: float
    height_m: float
    dome_height_m: float


class Shell(Parameters):
    """Upright closed body of revolution over the floor on its mounts.

    A cylinder with flat or domed caps, or straight lines between points.
    """

    outer_diameter_m: Annotated[float | None, OUTSIDE] = Field(default=None, ge=0.02, le=2.0)
    height_m: Annotated[float | None, OUTSIDE] = Field(default=None, ge=0.02, le=3.0)
    """Height from bottom to top, domes included."""
    dome_height_m: Annotated[float, OUTSIDE] = Field(default=0.0, ge=0.0, le=1.0)
    """Height of each cap, a half-ellipsoid; 0 is flat."""
    profile_m: Annotated[tuple[Point, ...] | None, OUTSIDE] = None
    """Radius and height above the lowest point, from the bottom of the axis to its top, in place
    of the cylinder's values."""
    centre_of_mass_height_m: Annotated[float, OUTSIDE] = Field(gt=0.0, le=3.0)
    """Height of the machine's centre of mass above the bottom of the shell."""
    floor_clearance_m: Annotated[float, OUTSIDE] = Field(ge=0.0, le=0.5)
    """Height of the bottom of the shell above the floor."""
    lines_to_add: ClassVar[str] = f"needs {_SIZE}; centre_of_mass_height_mm, floor_clearance_mm"

    def contradictions(self) -> Contradictions:
        if self.profile_m is None:
            yield from self._of_cylinder()
        else:
            yield from self._of_profile(self.profile_m)
        height_m = self.profile.height_m
        if self.centre_of_mass_height_m >= height_m:
            yield (
                f"centre_of_mass_height_mm = {1e3 * self.centre_of_mass_height_m:g} mm: must be "
                f"below {1e3 * height_m:g} mm, the height of the shell"
            )

    def _of_cylinder(self) -> Contradictions:
        missing = [
            name
            for name, value in (
                ("outer_diameter_mm", self.outer_diameter_m),
                ("height_mm", self.height_m),
            )
            if value is None
        ]
        if missing:
            yield f"{', '.join(missing)}: missing; give {_SIZE}"
        if 2.0 * self.dome_height_m > self.cylinder.height_m:
            yield (
                f"dome_height_mm = {1e3 * self.dome_height_m:g} mm: must be at most half of "
                f"height_mm = {1e3 * self.cylinder.height_m:g} mm"
            )

    def _of_profile(self, points: tuple[Point, ...]) -> Contradictions:
        if self.outer_diameter_m is not None or self.height_m is not None or self.dome_height_m:
            yield (
                "profile_mm: takes the place of outer_diameter_mm, height_mm and dome_height_mm; "
                "give one or the other"
            )
        for problem in why_no_body(points):
            yield f"profile_mm: {problem}"
        under = next(number for number, (_, height) in enumerate(points) if height > 0.0)
        if self.floor_clearance_m == 0.0 and any(height == 0.0 for _, height in points[under:]):
            yield (
                "floor_clearance_mm = 0 mm: the bottom of profile_mm would enclose air on the "
                "floor; it may touch the floor around the axis alone"
            )

    @property
    def cylinder(self) -> Cylinder:
        """Its size where it is a cylinder.

        Raises
        ------
        ParameterError
            It is given by points.
        """
        if self.outer_diameter_m is None or self.height_m is None:
            raise ParameterError("shell.profile_mm: is no cylinder with caps")
        return Cylinder(self.outer_diameter_m / 2.0, self.height_m, self.dome_height_m)

    @property
    def profile(self) -> Profile:
        """Its outside, about the machine's centre of mass."""
        return shell_profile(vars(self))

    def distance_m(self, x_m: float, y_m: float, height_m: float) -> float:
        """Return the distance of a point from the shell, m; zero in it.

        Parameters
        ----------
        x_m, y_m : from the axis
        height_m : above the floor
        """
        return self.profile.distance_m(hypot(x_m, y_m), self.floor_z_m + height_m)

    @property
    def floor_z_m(self) -> float:
        """Vertical coordinate of the floor; the origin is the centre of mass at rest."""
        return -self.centre_of_mass_height_m - self.floor_clearance_m
