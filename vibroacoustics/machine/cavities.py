"""Spaces of gas between the shell's wall and parts in it, through which a source's gas drives it.

A machine without such a table leaves the sound of that gas out.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Annotated, Final

from pydantic import Field

from ..base.parameters import Contradictions, Held, Parameters
from ..mechanics.ports import Port
from .frame import SHELL_TABLES
from .shell import Shell

SHAPE: Final = Held("bound a space of gas: another one makes other modes of it")
ANGLE = Field(default=0.0, ge=-2.0 * pi, le=2.0 * pi)
QUALITY = Field(ge=2.0, le=1e4)


class DischargeDome(Parameters):
    """Space under the shell's top cap, over a rigid partition, which the discharge port feeds."""

    depth_m: Annotated[float, SHAPE] = Field(ge=1e-3, le=1.0)
    """Depth of the partition below the rim of the cap."""
    port_offset_m: float = Field(ge=0.0, le=0.5)
    """Offset of the port in the partition from the axis."""
    port_angle_rad: float = ANGLE
    """Angle of the port, from x towards y."""
    tube_diameter_m: float = Field(ge=2e-3, le=0.2)
    """Inner, of the discharge tube through the wall, which sound leaves without reflection."""
    tube_height_m: float = Field(ge=0.0, le=1.0)
    """Height of the tube's middle over the partition."""
    tube_angle_rad: float = ANGLE
    quality_ratio: float = QUALITY
    """Q of the gas: its loss factor, but for the tube, is one over it."""

    def contradictions(self) -> Contradictions:
        if self.tube_height_m > self.depth_m:
            yield (
                f"tube_height_mm = {1e3 * self.tube_height_m:g} mm: must be at most depth_mm = "
                f"{1e3 * self.depth_m:g} mm, where the cap begins"
            )

    def why_not_in(self, shell: Shell) -> str | None:
        """Say why a shell cannot have it; None where it can."""
        size = shell.cylinder
        wall = size.height_m - 2.0 * size.dome_height_m
        if self.depth_m >= wall:
            return (
                f"depth_mm = {1e3 * self.depth_m:g} mm: must be below {1e3 * wall:g} mm, the "
                "height of the wall between the caps"
            )
        if self.port_offset_m >= size.radius_m:
            return (
                f"port_offset_mm = {1e3 * self.port_offset_m:g} mm: must be below "
                f"{1e3 * size.radius_m:g} mm, the radius of the shell"
            )
        return None


class SuctionAnnulus(Parameters):
    """Space between the wall and the parts in it, out of which the suction pockets fill."""

    inner_radius_m: Annotated[float, SHAPE] = Field(gt=0.0, le=1.0)
    lower_height_m: Annotated[float, SHAPE] = Field(ge=-2.0, le=2.0)
    """Height of its lower face, from the centre of mass."""
    upper_height_m: Annotated[float, SHAPE] = Field(ge=-2.0, le=2.0)
    inlets: int = Field(ge=1, le=8)
    """Openings from it to the pockets, alike around the axis."""
    inlet_height_m: float = Field(ge=-2.0, le=2.0)
    inlet_angle_rad: float = ANGLE
    """Angle of one inlet, from x towards y."""
    sound_speed_m_per_s: float = Field(ge=50.0, le=2000.0)
    stiffness_exponent_ratio: float = Field(gt=1.0, le=2.0)
    """κ = ρ c²/p of the gas, which gives its density at the suction pressure."""
    quality_ratio: float = QUALITY

    def contradictions(self) -> Contradictions:
        lower, inlet, upper = self.lower_height_m, self.inlet_height_m, self.upper_height_m
        if not lower <= inlet <= upper or lower == upper:
            yield (
                f"inlet_height_mm = {1e3 * inlet:g} mm: must lie between lower_height_mm = "
                f"{1e3 * lower:g} mm and upper_height_mm = {1e3 * upper:g} mm"
            )

    def why_not_in(self, shell: Shell) -> str | None:
        """Say why a shell cannot have it; None where it can."""
        size = shell.cylinder
        bottom = size.dome_height_m - shell.centre_of_mass_height_m
        top = size.height_m - size.dome_height_m - shell.centre_of_mass_height_m
        if not bottom < self.lower_height_m < self.upper_height_m < top:
            return (
                f"lower_height_mm, upper_height_mm = {1e3 * self.lower_height_m:g}, "
                f"{1e3 * self.upper_height_m:g} mm: must rise and lie between "
                f"{1e3 * bottom:g} and {1e3 * top:g} mm, the ends of the wall"
            )
        if self.inner_radius_m >= 0.98 * size.radius_m:
            return (
                f"inner_radius_mm = {1e3 * self.inner_radius_m:g} mm: must be below "
                f"{0.98e3 * size.radius_m:g} mm, 0.98 of the radius of the shell"
            )
        return None

    def density_kg_per_m3(self, pressure_pa: float) -> float:
        """ρ = κ p/c²."""
        return self.stiffness_exponent_ratio * pressure_pa / self.sound_speed_m_per_s**2


class DischargeMuffler(Parameters):
    """An expansion chamber in the discharge tube; the tube goes on without reflection."""

    distance_m: float = Field(ge=0.0, le=20.0)
    """Distance from the shell, along the tube."""
    length_m: float = Field(ge=1e-3, le=5.0)
    diameter_m: float = Field(ge=2e-3, le=1.0)
    """Inner."""


SPACES: Final[Mapping[str, type[Parameters]]] = {
    "discharge_dome": DischargeDome,
    "suction_annulus": SuctionAnnulus,
}
"""Spaces of gas that sources may feed, by the name of the machine's table."""


@dataclass(frozen=True, kw_only=True)
class GasPort(Port):
    """A space of gas in the shell, one of `SPACES`, fed by a volume flow, m³/s.

    Attributes
    ----------
    components, tables : components and tables, see `Port`
    density_kg_per_m3, sound_speed_m_per_s : density and speed of sound of the gas there

    Examples
    --------
    >>> port = va.GasPort("discharge_dome", density_kg_per_m3=112.0, sound_speed_m_per_s=178.0)
    >>> port.components
    ('flow',)
    """

    components: tuple[str, ...] = ("flow",)
    tables: tuple[type[Parameters], ...] = (*SPACES.values(), *SHELL_TABLES)
    density_kg_per_m3: float
    sound_speed_m_per_s: float
