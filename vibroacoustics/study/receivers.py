"""Positions of the microphones."""

from math import hypot

from pydantic import Field

from ..base.parameters import Parameters


class Receiver(Parameters):
    """One microphone. x along the Oldham stroke, y across, height above the floor."""

    x_m: float = Field(ge=-20.0, le=20.0)
    y_m: float = Field(ge=-20.0, le=20.0)
    height_m: float = Field(ge=0.0, le=20.0)

    @property
    def distance_m(self) -> float:
        """Distance from the foot of the machine's axis on the floor."""
        return hypot(self.x_m, self.y_m, self.height_m)
