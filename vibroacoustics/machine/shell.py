"""The compressor's shell as a sound radiator."""

from math import hypot
from typing import Annotated, Final

from pydantic import Field

from ..base.parameters import Contradictions, Held, Parameters

OUTSIDE: Final = Held("give the outside of the shell: each value needs a radiation of its own")


class Shell(Parameters):
    """Upright closed cylinder with flat or domed caps, over the floor on its mounts."""

    outer_diameter_m: Annotated[float, OUTSIDE] = Field(ge=0.02, le=2.0)
    height_m: Annotated[float, OUTSIDE] = Field(ge=0.02, le=3.0)
    """From bottom to top, domes included."""
    dome_height_m: Annotated[float, OUTSIDE] = Field(default=0.0, ge=0.0, le=1.0)
    """Height of each cap, a half-ellipsoid; 0 is flat."""
    centre_of_mass_height_m: Annotated[float, OUTSIDE] = Field(gt=0.0, le=3.0)
    """Height of the machine's centre of mass above the bottom of the shell."""
    floor_clearance_m: Annotated[float, OUTSIDE] = Field(ge=0.0, le=0.5)
    """Height of the bottom of the shell above the floor."""

    def contradictions(self) -> Contradictions:
        if self.centre_of_mass_height_m >= self.height_m:
            yield (
                f"centre_of_mass_height_mm = {1e3 * self.centre_of_mass_height_m:g} mm: must be "
                f"below height_mm = {1e3 * self.height_m:g} mm"
            )
        if 2.0 * self.dome_height_m > self.height_m:
            yield (
                f"dome_height_mm = {1e3 * self.dome_height_m:g} mm: must be at most half of "
                f"height_mm = {1e3 * self.height_m:g} mm"
            )

    @property
    def radius_m(self) -> float:
        return self.outer_diameter_m / 2.0

    def distance_m(self, x_m: float, y_m: float, height_m: float) -> float:
        """Distance of a point, given by its height above the floor, from the shell's surface."""
        above_bottom = height_m - self.floor_clearance_m
        sideways = max(hypot(x_m, y_m) - self.radius_m, 0.0)
        return hypot(sideways, max(above_bottom - self.height_m, -above_bottom, 0.0))

    @property
    def floor_z_m(self) -> float:
        """Vertical coordinate of the floor; the origin is the centre of mass at rest."""
        return -self.centre_of_mass_height_m - self.floor_clearance_m
