"""Gas beyond a reciprocating compressor's valves: discharge muffler and line, gas in the shell."""

from math import pi
from typing import Final

from pydantic import Field

from ..base.parameters import Parameters

GAS_PATH_PARTLY: Final = (
    "Gas is included only where a study's sources name it: in an empty shell, without its effect "
    "on the block. Gas and bearing forces are pairs within the rigid block. Oil, and walls that "
    "bend, are neglected."
)
SOUND = Field(ge=50.0, le=1500.0)
DENSITY = Field(ge=0.05, le=500.0)


class DischargeGas(Parameters):
    """Muffler behind the discharge valve, and a tube that reflects nothing at its far end."""

    muffler_volume_m3: float = Field(ge=1e-8, le=1.0)
    speed_of_sound_m_per_s: float = SOUND
    density_kg_per_m3: float = DENSITY


class ShellGas(Parameters):
    """Gas in the shell as an empty cylinder, from which the suction valve takes gas."""

    radius_m: float = Field(ge=5e-3, le=5.0)
    height_m: float = Field(ge=5e-3, le=5.0)
    middle_height_m: float = Field(ge=-2.0, le=2.0)
    """Height of its middle above the shell's centre of mass."""
    speed_of_sound_m_per_s: float = SOUND
    density_kg_per_m3: float = DENSITY
    loss_factor_ratio: float = Field(gt=0.0, le=1.0)
    """Loss factor of its modes."""
    intake_ratio: float = Field(ge=0.0, le=1.0)
    """Distance of the intake from the axis, over the radius."""
    intake_angle_rad: float = Field(ge=-2.0 * pi, le=2.0 * pi)
    """Angle from x towards y."""
