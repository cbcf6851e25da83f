"""What follows a stop: trapped gas turns the shaft back until the brake jams, a valve shuts."""

from math import pi
from typing import Annotated

from pydantic import Field

from ..base.parameters import Parameters
from .stopping import AS_GIVEN


class TurningBack(Parameters):
    """Trapped gas and the brake that stops the shaft against it."""

    trapped_volume_m3: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1.0)
    """Between the scrolls and the valve that shuts behind them: it expands as the shaft turns."""
    free_angle_rad: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=200.0 * pi)
    """By which the shaft turns back before the brake jams; many turns for a machine without."""
    wall_radius_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=0.5)
    """From the shaft's axis to the wall against which the brake is pressed."""
    contact_stiffness_n_per_m1p5: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e15)
    """Around the shaft, of brake and wall, as of a Hertz contact."""
    restitution_ratio: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1.0)
    friction_ratio: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1.0)
    """Of brake and wall: the brake is pressed outwards by the tangential force over it."""


class CheckValve(Parameters):
    """A disc that shuts the discharge when the flow turns back, along the shaft."""

    mass_kg: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=10.0)
    lift_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=0.1)
    closing_force_n: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e5)
    """Of spring and flow, taken as constant."""
    seat_stiffness_n_per_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e13)
