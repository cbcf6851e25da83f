"""The air gap of a motor."""

from math import pi

from pydantic import Field

from ...base.parameters import Parameters

RATIO = Field(ge=0.0, le=1.0)
ANGLE = Field(default=0.0, ge=-2.0 * pi, le=2.0 * pi)


class AirGap(Parameters):
    """Flux density, slots, eccentricity. Windings' steps and saturation are neglected."""

    flux_density_t: float = Field(gt=0.0, le=3.0)
    """Peak of the fundamental wave that turns forwards."""
    stator_slots: int = Field(ge=3, le=500)
    rotor_slots: int = Field(ge=3, le=500)
    """Bars of a squirrel cage; magnets have none."""
    stator_slot_ratio: float = RATIO
    """Wave of the permeance by the slots over its mean."""
    rotor_slot_ratio: float = RATIO
    static_eccentricity_ratio: float = RATIO
    """Offset of the rotor's middle from the stator's, over the gap."""
    static_angle_rad: float = ANGLE
    """Angle of the narrowest gap, from x."""
    dynamic_eccentricity_ratio: float = RATIO
    """Radius of the circle of the rotor's middle about the stator's, over the gap."""
    dynamic_angle_rad: float = ANGLE
    """Angle of the narrowest gap ahead of the crank pin."""
