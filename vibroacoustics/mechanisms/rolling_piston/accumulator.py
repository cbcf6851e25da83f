"""The suction accumulator on its bracket: a rigid body with modes of its own."""

import numpy as np
from pydantic import Field

from ...base.parameters import Parameters
from ...mechanics.bushings import AttachedBodies, Bushing, RigidBody
from ...mechanics.capabilities import HEIGHT
from ...mechanics.ports import HOUSING

NAME = "accumulator"
STIFFNESS = Field(gt=0.0, le=1e12)


class Accumulator(Parameters):
    """A filled cylinder beside the shell, held by its bracket and the suction tube."""

    mass_kg: float = Field(gt=0.0, le=100.0)
    radius_m: float = Field(gt=0.0, le=0.5)
    length_m: float = Field(gt=0.0, le=1.0)
    distance_m: float = Field(gt=0.0, le=1.0)
    """Distance of its axis from the shaft's axis, along x."""
    height_m: float = HEIGHT
    """Height of its middle from the centre of mass at rest."""
    bracket_height_m: float = HEIGHT
    """Height of bracket and tube as one elastic joint."""
    stiffness_n_per_m: float = STIFFNESS
    """Alike along all axes."""
    angular_stiffness_n_m: float = STIFFNESS
    """Alike about all axes."""
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)

    @property
    def attached(self) -> AttachedBodies:
        """Solid cylinder on one bushing to the housing."""
        axial = 0.5 * self.mass_kg * self.radius_m**2
        across = 0.5 * axial + self.mass_kg * self.length_m**2 / 12.0
        inertia = np.diag([across, across, axial])
        centre = np.array([self.distance_m, 0.0, self.height_m])
        joint = np.array([self.distance_m, 0.0, self.bracket_height_m])
        stiffness = np.diag([self.stiffness_n_per_m] * 3 + [self.angular_stiffness_n_m] * 3)
        bracket = Bushing(
            "bracket", NAME, HOUSING.name, joint, stiffness,
            loss_factor_ratio=self.loss_factor_ratio,
        )  # fmt: skip
        return AttachedBodies((RigidBody(NAME, self.mass_kg, inertia, centre),), (bracket,))
