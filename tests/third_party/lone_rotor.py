"""A third party's kind of machine: a rotor with an unbalance, and nothing else that moves."""

from typing import ClassVar

from pydantic import Field

import vibroacoustics
from vibroacoustics import Revolution, circling, constant_rotation, wrenches_of_parts


@vibroacoustics.register
class LoneRotor(vibroacoustics.Machine):
    """An upright shaft with one heavy spot."""

    kind: ClassVar[str] = "lone-rotor"
    axes: ClassVar[str] = "to the front (x), to the side (y) and up (z)"
    unbalance_mass_kg: float = Field(gt=0.0, le=1.0)
    unbalance_radius_m: float = Field(gt=0.0, le=0.1)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """The heavy spot on its circle at constant speed."""
        rotation = constant_rotation(speed_rpm, samples)
        spot = circling(
            "heavy_spot",
            self.unbalance_mass_kg,
            self.unbalance_radius_m,
            0.0,
            rotation.crank_angle,
        )
        return Revolution(speed_rpm, rotation, wrenches_of_parts([spot], rotation))

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Everything else."""
        return ("The rotor's bearings are left out.",)
