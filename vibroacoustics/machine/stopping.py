"""Stopping of a machine: what slows the shaft, and how far the brake lets the orbiting set turn."""

from typing import Annotated, Final

from pydantic import Field, model_validator

from ..base.parameters import Held, Parameters

AS_GIVEN: Final = Held("act on stops, which are computed with the values as given")


class Stopping(Parameters):
    shaft_inertia_kg_m2: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=1e3)
    """About the shaft's axis, of all that turns with it but the machine's moving parts."""
    gas_share_ratio: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=2.0)
    """Gas torque of the run-down over that of steady running; 0 is a machine without load."""
    friction_torque_n_m: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=1e4)
    """Independent of the speed."""
    viscous_torque_n_m_s: Annotated[float, AS_GIVEN] = Field(ge=0.0, le=1e2)
    """Per rad/s of speed."""
    shift_rad: Annotated[float, AS_GIVEN] = Field(ge=-0.8, le=0.8)
    """Angle by which the set runs ahead of the crank pin and the counterweights in the end."""
    shift_duration_s: Annotated[float, AS_GIVEN] = Field(gt=0.0, le=10.0)
    """From switch-off until the set has turned by that angle."""

    @model_validator(mode="after")
    def _stops(self) -> "Stopping":
        if self.gas_share_ratio == 0.0 and self.friction_torque_n_m == 0.0:
            raise ValueError(
                "gas_share_ratio = 0, friction_torque_n_m = 0 N m: one must be above zero, viscous "
                "drag alone never brings the shaft to rest"
            )
        return self
