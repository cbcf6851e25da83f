"""Stopping of a machine: what slows the shaft, and how far the brake lets the orbiting set turn."""

from math import pi
from typing import Annotated, Final

from pydantic import Field

from ..base.parameters import Contradictions, Held, Parameters

AS_GIVEN: Final = Held("act on stops only, which are computed for one sample")


class TurningBack(Parameters):
    """Trapped gas and the brake that stops the shaft against it."""

    trapped_volume_m3: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1.0)
    """Volume between the scrolls and the valve that shuts behind them: it expands as the shaft
    turns."""
    free_angle_rad: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=200.0 * pi)
    """Angle by which the shaft turns back before the brake jams; many turns for a machine
    without."""
    wall_radius_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=0.5)
    """Radius from the shaft's axis to the wall against which the brake is pressed."""
    contact_stiffness_n_per_m1p5: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e15)
    """Stiffness around the shaft, of brake and wall, for a Hertz contact."""
    restitution_ratio: Annotated[float, AS_GIVEN] = Field(ge=0.2, le=1.0)
    friction_ratio: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1.0)
    """Friction of brake and wall: the brake is pressed outwards by the tangential force over it."""


class CheckValve(Parameters):
    """A disc that shuts the discharge when the flow turns back, along the shaft."""

    mass_kg: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=10.0)
    lift_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=0.1)
    closing_force_n: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e5)
    """Force of spring and flow, taken as constant."""
    seat_stiffness_n_per_m: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e13)


class Stopping(Parameters):
    shaft_inertia_kg_m2: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e3)
    """Inertia about the shaft's axis, of all that turns with it but the machine's moving parts."""
    gas_share_ratio: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=2.0)
    """Gas torque of the run-down over that of steady running; 0 is a machine without load."""
    friction_torque_n_m: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=1e4)
    """Independent of the speed."""
    viscous_torque_n_m_s: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=1e2)
    """Torque per rad/s of speed."""
    shift_rad: Annotated[float, AS_GIVEN] = Field(ge=-0.8, le=0.8)
    """Angle by which the set runs ahead of the crank pin and the counterweights in the end."""
    shift_duration_s: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=10.0)
    """Time from switch-off until the set has turned by that angle."""

    def contradictions(self) -> Contradictions:
        if self.gas_share_ratio == 0.0 and self.friction_torque_n_m == 0.0:
            yield (
                "gas_share_ratio = 0, friction_torque_n_m = 0 N m: one must be above zero, viscous "
                "drag alone never brings the shaft to rest"
            )
