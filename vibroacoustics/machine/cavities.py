"""Spaces of gas between the shell's wall and parts in it, through which a source's gas drives it.

A machine without such a table leaves the sound of that gas out.
"""

from math import pi
from typing import Annotated, Final

from pydantic import Field, model_validator

from ..base.parameters import Held, Parameters
from .shell import Shell

SHAPE: Final = Held("bound a space of gas: another one makes other modes of it")
ANGLE = Field(default=0.0, ge=-2.0 * pi, le=2.0 * pi)
QUALITY = Field(ge=2.0, le=1e4)


class DischargeDome(Parameters):
    """Space under the shell's top cap, over a rigid partition, which the discharge port feeds."""

    depth_m: Annotated[float, SHAPE] = Field(ge=1e-3, le=1.0)
    """Of the partition below the rim of the cap."""
    port_offset_m: float = Field(ge=0.0, le=0.5)
    """Of the port in the partition from the axis."""
    port_angle_rad: float = ANGLE
    """Of the port, from x towards y."""
    tube_diameter_m: float = Field(ge=2e-3, le=0.2)
    """Inner, of the discharge tube through the wall, which sound leaves without reflection."""
    tube_height_m: float = Field(ge=0.0, le=1.0)
    """Of the tube's middle over the partition."""
    tube_angle_rad: float = ANGLE
    quality_ratio: float = QUALITY
    """Q of the gas: its loss factor, but for the tube, is one over it."""

    @model_validator(mode="after")
    def _tube_in_wall(self) -> "DischargeDome":
        if self.tube_height_m > self.depth_m:
            raise ValueError(
                f"tube_height_mm = {1e3 * self.tube_height_m:g} mm: must be at most depth_mm = "
                f"{1e3 * self.depth_m:g} mm, where the cap begins"
            )
        return self

    def why_not_in(self, shell: Shell) -> str | None:
        """Why a shell cannot have it; None where it can."""
        wall = shell.height_m - 2.0 * shell.dome_height_m
        if self.depth_m >= wall:
            return (
                f"depth_mm = {1e3 * self.depth_m:g} mm: must be below {1e3 * wall:g} mm, the "
                "height of the wall between the caps"
            )
        if self.port_offset_m >= shell.radius_m:
            return (
                f"port_offset_mm = {1e3 * self.port_offset_m:g} mm: must be below "
                f"{1e3 * shell.radius_m:g} mm, the radius of the shell"
            )
        return None
