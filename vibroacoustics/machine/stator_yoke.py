"""The stator's yoke as a ring in the shell, on which magnetic forces bend it."""

from typing import Final

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from ..mechanics.ports import Port
from .frame import SHELL_TABLES

RADIUS = Field(gt=0.0, le=1.0)


class StatorYoke(Parameters):
    """A uniform ring, fitted into the shell all around where the machine's stator is."""

    bore_radius_m: float = RADIUS
    """Radius of the stator, where the forces act."""
    mean_radius_m: float = RADIUS
    """Middle of the yoke."""
    thickness_m: float = RADIUS
    """Thickness of the yoke behind the slots."""
    length_m: float = RADIUS
    """Length of the stack."""
    youngs_modulus_pa: float = Field(gt=0.0, le=1e13)
    """Young's modulus of the laminations in their plane."""
    density_kg_per_m3: float = Field(gt=0.0, le=1e5)
    teeth_mass_ratio: float = Field(ge=0.0, le=10.0)
    """Teeth and windings over the yoke: they move with it and do not stiffen it."""
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)
    fit_stiffness_n_per_m: float = Field(gt=0.0, le=1e15)
    """Stiffness between yoke and wall, outwards, all around together."""

    def contradictions(self) -> Contradictions:
        if self.thickness_m >= self.mean_radius_m:
            yield (
                f"thickness_mm = {1e3 * self.thickness_m:g} mm: must be below the mean radius, "
                f"{1e3 * self.mean_radius_m:g} mm"
            )
        if self.bore_radius_m > self.mean_radius_m - 0.5 * self.thickness_m:
            yield (
                f"bore_radius_mm = {1e3 * self.bore_radius_m:g} mm: reaches into the yoke, whose "
                f"inner radius is {1e3 * (self.mean_radius_m - 0.5 * self.thickness_m):g} mm"
            )


YOKE_ORDERS: Final = (0, 2, 3, 4, 5, 6)
"""Waves around the stator's yoke that press on the wall; one wave is a force on the stator."""
STATOR_YOKE: Final = Port(
    "stator_yoke",
    tuple(f"wave {order}" for order in YOKE_ORDERS for _ in ("cos", "sin")),
    (StatorYoke, *SHELL_TABLES),
)
"""Line load outwards on the yoke's middle, N/m, parts with cos nθ and sin nθ of `YOKE_ORDERS`."""
