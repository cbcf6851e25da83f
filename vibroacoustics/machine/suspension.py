"""The springs inside the shell that carry the block with mechanism and motor."""

from typing import Annotated, Final

from pydantic import Field, WithJsonSchema

from ..base.parameters import Contradictions, Parameters
from ..mechanics.ports import BodyPort
from .feet import Mounts
from .housing import Housing

BLOCK: Final = BodyPort("block")
"""The block on springs with the mechanism; the shell around it is the port `HOUSING`."""


_FARTHEST_M: Final = 10.0
# Limits for the schema of files; `DischargeTube` refuses them in words of its own.
_SHOWN = WithJsonSchema({"type": "number", "minimum": -_FARTHEST_M, "maximum": _FARTHEST_M})
_Position = Annotated[float, _SHOWN]


class DischargeTube(Parameters):
    """A bent tube from the block to the shell, without mass.

    Its centre line runs through the points x, y, z from the block's centre of mass at rest.
    """

    outer_diameter_m: float = Field(gt=0.0, le=0.1)
    inner_diameter_m: float = Field(ge=0.0, le=0.1)
    x_m: tuple[_Position, ...] = Field(min_length=2, max_length=1000)
    y_m: tuple[_Position, ...]
    z_m: tuple[_Position, ...]
    youngs_modulus_pa: float = Field(ge=1e6, le=1e12)
    poisson_ratio: float = Field(gt=-1.0, le=0.5)
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)

    def contradictions(self) -> Contradictions:
        if not len(self.x_m) == len(self.y_m) == len(self.z_m):
            yield "x_mm, y_mm, z_mm: must be as long as each other"
        farthest_m = max(map(abs, (*self.x_m, *self.y_m, *self.z_m)))
        if farthest_m > _FARTHEST_M:
            yield (
                f"x_mm, y_mm, z_mm: farthest is {1e3 * farthest_m:.4g} mm; "
                f"must be within {1e3 * _FARTHEST_M:g} mm"
            )
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
    """Height of the block's centre of mass above the shell's."""
    springs: Mounts
    springs_height_m: float = Field(ge=-2.0, le=2.0)
    """Height of the springs from the block's centre of mass."""
    discharge_tube: DischargeTube | None = None
