"""A scroll compressor with an Oldham coupling: masses, places, shell, mounts, published noise.

Heights are those of the machine's frame: z up, zero at the centre of mass at rest.
"""

from typing import Literal

from pydantic import Field, model_validator

from .base import Parameters
from .mounts import Mounts
from .shell import Shell

HEIGHT = Field(ge=-2.0, le=2.0)
PART_MASS = Field(gt=0.0, le=100.0)


class Housing(Parameters):
    """The machine as one rigid body, moving parts included."""

    mass_kg: float = Field(ge=0.1, le=1e4)
    inertia_xx_kg_m2: float = Field(gt=0.0, le=1e4)
    inertia_yy_kg_m2: float = Field(gt=0.0, le=1e4)
    inertia_zz_kg_m2: float = Field(gt=0.0, le=1e4)

    @model_validator(mode="after")
    def _triangle_inequality(self) -> "Housing":
        moments = sorted((self.inertia_xx_kg_m2, self.inertia_yy_kg_m2, self.inertia_zz_kg_m2))
        if moments[2] > moments[0] + moments[1]:
            raise ValueError(
                "inertia_*_kg_m2: the largest moment of inertia must not exceed the sum of the "
                f"others, got {moments[2]:g} > {moments[0]:g} + {moments[1]:g} kg m²"
            )
        return self


class Kinematics(Parameters):
    orbit_radius_m: float = Field(ge=1e-4, le=0.05)
    """Radius of the orbit of the scroll; the Oldham ring's stroke amplitude equals it."""


class OldhamRing(Parameters):
    mass_kg: float = PART_MASS
    height_m: float = HEIGHT


class OrbitingPart(Parameters):
    """A part whose centre of mass circles the shaft axis, in phase with the crank pin."""

    mass_kg: float = PART_MASS
    radius_m: float | None = Field(default=None, gt=0.0, le=0.5)
    """Radius of its circle; the orbit radius where none is given."""
    height_m: float = HEIGHT


class Counterweights(Parameters):
    """Two balance planes; the mass moments follow from two-plane balance of the orbiting parts."""

    upper_height_m: float = HEIGHT
    lower_height_m: float = HEIGHT
    radius_m: float = Field(gt=0.0, le=0.5)

    @model_validator(mode="after")
    def _planes_apart(self) -> "Counterweights":
        if self.upper_height_m - self.lower_height_m < 1e-3:
            raise ValueError(
                f"upper_height_mm = {1e3 * self.upper_height_m:g} mm: must be at least 1 mm above "
                f"lower_height_mm = {1e3 * self.lower_height_m:g} mm"
            )
        return self


class PublishedNoise(Parameters):
    """The catalogue's sound pressure level."""

    level_dba: float = Field(ge=0.0, le=140.0)
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    distance_m: float = Field(ge=0.1, le=20.0)


class Erratum(Parameters):
    """An error in the source document: what is printed, what is right."""

    item: str
    printed: str
    finding: str


class Machine(Parameters):
    name: str = Field(min_length=1)
    kind: Literal["oldham-scroll"]
    housing: Housing
    kinematics: Kinematics
    oldham: OldhamRing
    orbiting_scroll: OrbitingPart
    crank_pin: OrbitingPart
    brake: OrbitingPart
    counterweights: Counterweights
    mounts: Mounts
    shell: Shell
    published_noise: PublishedNoise
    errata: tuple[Erratum, ...] = ()
