"""A third party's balancer: a second shaft with one weight that turns against the first."""

from typing import ClassVar

from pydantic import Field

import vibroacoustics
from vibroacoustics import Added, Machine, Revolution, circling


@vibroacoustics.register
class CounterShaft(vibroacoustics.Option):
    """One weight on a shaft of its own, geared to turn the other way."""

    kind: ClassVar[str] = "counter-shaft"
    labels: ClassVar[dict[str, str]] = {"gear_power_w": "Power lost in the gears"}
    mass_kg: float = Field(gt=0.0, le=1.0)
    radius_m: float = Field(gt=0.0, le=0.1)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """A mass on a circle against the sense of the crank, and what its gears lose."""
        angle = -revolution.rotation.crank_angle
        weight = circling("balancer", self.mass_kg, -self.radius_m, 0.0, angle)
        return Added((weight,), {"added_mass_kg": self.mass_kg, "gear_power_w": 2.5})

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Its gears."""
        return ("The gears of the second shaft run without noise.",)

    def sentences(self, figures: dict) -> tuple[str, ...]:
        """What the gears cost."""
        return (f"Its gears cost {figures['gear_power_w'][0]:.1f} W.",)
