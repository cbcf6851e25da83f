"""A third party's source: a random force up and down on the machine, as from a bearing."""

from typing import ClassVar

import numpy as np
from pydantic import Field

import vibroacoustics
from vibroacoustics import HOUSING, Case, Loads, Noise


@vibroacoustics.register
class Rumble(vibroacoustics.Source):
    """White noise up to the highest frequency, through the centre of mass."""

    kind: ClassVar[str] = "rumble"
    label: ClassVar[str] = "rumble of the bearings"
    force_n: float = Field(ge=0.0)
    """Root mean square."""
    step_hz: float = Field(default=1.0, gt=0.0)

    def loads(self, case: Case, before: dict) -> Loads:
        """One random force along z; each line stands for the step around it."""
        frequency = np.arange(0.5, case.maximum_frequency_hz / self.step_hz) * self.step_hz
        density = self.force_n**2 / (frequency.size * self.step_hz)
        upwards = np.eye(6)[:, 2:3]
        noise = Noise({HOUSING: upwards}, frequency, np.full((1, 1, frequency.size), density))
        return Loads(noise=(noise,))
