"""The compressor's shell as an elastic body, and the joints through which its inside drives it."""

from math import pi
from typing import Annotated, ClassVar, Final

from pydantic import Field

from ..base.parameters import Contradictions, Held, Parameters

JOINTS: Final = ("bearing_housing", "fixed_scroll", "stator")
"""Inner parts that are fixed to the wall."""


class Joint(Parameters):
    """An internal part fixed to the wall: equal welds or pads around a band of it."""

    height_m: float = Field(ge=-2.0, le=2.0)
    """Middle of the band, from the centre of mass."""
    band_m: float = Field(default=0.0, ge=0.0, le=1.0)
    """Height of the band; 0 is a line."""
    welds: int = Field(ge=1, le=64)
    """Number of welds, evenly spaced."""
    first_angle_rad: float = Field(default=0.0, ge=-2.0 * pi, le=2.0 * pi)
    """Middle of one weld, from x towards y."""
    spread_rad: float = Field(default=0.0, ge=0.0, le=2.0 * pi)
    """Angle that one weld covers; 2π over the number of welds is a joint all around."""

    def contradictions(self) -> Contradictions:
        covered = self.welds * self.spread_rad
        if covered > 2.0 * pi * (1.0 + 1e-9):
            yield (
                f"spread_deg = {self.spread_rad * 180.0 / pi:g} °: {self.welds} welds cover "
                f"{covered * 180.0 / pi:g} °; at most 360 ° fit around"
            )


ENDS: Final = Held("say where the wall is kept round: another one makes other modes")


class ShellStructure(Parameters):
    """Wall and caps of one thickness and material."""

    thickness_m: float = Field(ge=2e-4, le=0.05)
    youngs_modulus_pa: float = Field(ge=1e8, le=1e13)
    poisson_ratio: float = Field(ge=0.0, le=0.49)
    density_kg_per_m3: float = Field(ge=100.0, le=1e5)
    loss_factor_ratio: float = Field(gt=0.0, le=1.0)
    """Structural, the same at every frequency."""
    span_m: Annotated[float | None, ENDS] = Field(default=None, gt=0.0, le=3.0)
    """Free length between the ends of the wall: at both of its ends internal parts or the skirts of
    the caps keep the section round. None: only the caps do, at the ends of the wall."""
    changes_modes: ClassVar[tuple[str, ...]] = (
        "thickness_m",
        "youngs_modulus_pa",
        "poisson_ratio",
        "density_kg_per_m3",
    )
    """Values that modes change with; they are sampled by projection on the nominal modes."""
    changes_shapes: ClassVar[tuple[str, ...]] = ("thickness_m", "poisson_ratio")
    """Those that also change the shapes of modes: their projection is not exact."""
    bearing_housing: Joint
    fixed_scroll: Joint
    stator: Joint


class ShellVariation(Parameters):
    """Differences of the real shell from the empty closed cylinder of the model."""

    mobility_change_db: float = Field(ge=-40.0, le=40.0)
    """Added to the level of every path through the shell."""
    frequency_factor_ratio: float = Field(ge=0.3, le=3.0)
    """Times every natural frequency: parts and oil inside add stiffness and mass."""
