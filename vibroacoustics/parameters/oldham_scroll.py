"""A scroll compressor with an Oldham coupling: masses and places of its moving parts."""

from typing import Literal

from pydantic import Field

from .base import Parameters
from .machine import PART_MASS, CommonMachine
from .oscillation import HEIGHT, UPRIGHT, BalancePlanes, Oscillation


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


class OldhamScroll(CommonMachine):
    kind: Literal["oldham-scroll"]
    kinematics: Kinematics
    oldham: OldhamRing
    orbiting_scroll: OrbitingPart
    crank_pin: OrbitingPart
    brake: OrbitingPart
    counterweights: BalancePlanes
    """The mass moments follow from two-plane balance of the orbiting parts."""

    @property
    def oscillation(self) -> Oscillation:
        """The Oldham ring."""
        return Oscillation(
            self.oldham.mass_kg,
            self.kinematics.orbit_radius_m,
            self.oldham.height_m,
            self.counterweights,
            UPRIGHT,
        )
