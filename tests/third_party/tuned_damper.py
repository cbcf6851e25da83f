"""A third party's balancer: a tuned mass damper on the housing."""

from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

import vibroacoustics
from vibroacoustics import HOUSING, AttachedBodies, Bushing, Machine, RigidBody

GUIDE = 1e4
"""Stiffness of the guide over that of the spring: it resonates at 100 times the frequency."""
STEEL_KG_PER_M3 = 7850.0


@vibroacoustics.register
class TunedDamper(vibroacoustics.Option):
    """A steel ball on a spring, guided along the directions in which it is tuned."""

    kind: ClassVar[str] = "tuned-damper"
    mass_kg: float = Field(gt=0.0, le=10.0)
    frequency_hz: float = Field(ge=1.0, le=1000.0)
    """Natural frequency on a housing that does not move."""
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)
    position_m: tuple[float, float, float]
    """From the centre of mass of the housing, z up."""
    directions: tuple[Literal["x", "y", "z"], ...] = Field(min_length=1, max_length=3)

    def attached(self, machine: Machine) -> AttachedBodies:
        """The ball, about which the guide turns as stiffly as it holds it across."""
        radius_m = (self.mass_kg / (4.0 / 3.0 * np.pi * STEEL_KG_PER_M3)) ** (1.0 / 3.0)
        inertia = 0.4 * self.mass_kg * radius_m**2
        square = (2.0 * np.pi * self.frequency_hz) ** 2
        along = [1.0 if axis in self.directions else GUIDE for axis in "xyz"]
        stiffness = square * np.diag(
            [*(self.mass_kg * factor for factor in along), *([GUIDE * inertia] * 3)]
        )
        ball = RigidBody("damper", self.mass_kg, inertia * np.eye(3), self.position_m)
        spring = Bushing(
            "damper_spring", ball.name, HOUSING.name, self.position_m, stiffness,
            loss_factor_ratio=self.loss_factor_ratio,
        )  # fmt: skip
        return AttachedBodies((ball,), (spring,))

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Its own sound and its stops."""
        return ("The ball of the tuned damper does not radiate sound and meets no stops.",)
