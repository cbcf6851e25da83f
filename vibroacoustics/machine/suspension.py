"""The springs inside the shell that carry the block with mechanism and motor."""

from typing import Final

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from ..mechanics.ports import BodyPort
from .housing import Housing
from .mounts import Mounts

BLOCK: Final = BodyPort("block")
"""The block on springs with the mechanism; the shell around it is the port `HOUSING`."""


class DischargeTube(Parameters):
    """A bent tube from the block to the shell, without mass.

    Its centre line runs through the points x, y, z from the block's centre of mass at rest.
    """

    outer_diameter_m: float = Field(gt=0.0, le=0.1)
    inner_diameter_m: float = Field(ge=0.0, le=0.1)
    x_m: tuple[float, ...] = Field(min_length=2, max_length=1000)
    y_m: tuple[float, ...]
    z_m: tuple[float, ...]
    youngs_modulus_pa: float = Field(ge=1e6, le=1e12)
    poisson_ratio: float = Field(gt=-1.0, le=0.5)
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)

    def contradictions(self) -> Contradictions:
        if not len(self.x_m) == len(self.y_m) == len(self.z_m):
            yield "x_mm, y_mm, z_mm: must be as long as each other"
        if self.inner_diameter_m >= self.outer_diameter_m:
            yield (
                f"inner_diameter_mm = {1e3 * self.inner_diameter_m:g} mm: must be below "
                f"outer_diameter_mm = {1e3 * self.outer_diameter_m:g} mm"
            )


class Suspension(Parameters):
    """Four equal springs in a square under or over the block, and the discharge tube."""

    block: Housing
    """Mass and moments of inertia of block, motor and moving parts."""
    height_m: float = Field(ge=-2.0, le=2.0)
    """Of the block's centre of mass above the shell's."""
    springs: Mounts
    springs_height_m: float = Field(ge=-2.0, le=2.0)
    """Of the springs from the block's centre of mass."""
    discharge_tube: DischargeTube | None = None
