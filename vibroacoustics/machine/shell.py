"""The compressor's shell as a sound radiator."""

from math import hypot
from typing import Annotated, ClassVar, Final, NamedTuple

from pydantic import Field

from ..base.errors import ParameterError
from ..base.parameters import Contradictions, Held, Parameters
from ..base.revolution import Point, Profile, shell_profile
from .profile_points import why_no_body

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
