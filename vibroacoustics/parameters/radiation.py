"""Settings of the radiation step: surroundings, grids, frequencies."""

from typing import Literal

from pydantic import Field, model_validator

from ..constants import SPEED_OF_SOUND_M_PER_S
from .base import Parameters


class RadiationSettings(Parameters):
    """Grid spacings and frequency range of the near field and of the room."""

    surroundings: Literal["free-field", "hard-floor"] = "hard-floor"
    near_field_spacing_m: float = Field(default=0.0125, ge=0.002, le=0.05)
    """Cell size of the cut-cell grid around the body."""
    room_spacing_m: float = Field(default=0.03, ge=0.005, le=0.1)
    """Largest node spacing of the k-Wave grid; it shrinks to fit the microphone's height."""
    maximum_frequency_hz: float = Field(default=2500.0, ge=50.0, le=10000.0)
    frequency_step_hz: float = Field(default=25.0, ge=1.0, le=100.0)
    """Spacing of the frequencies at which the transfer vectors are tabulated."""

    @model_validator(mode="after")
    def _grids_resolve_the_wave(self) -> "RadiationSettings":
        shortest_wave_m = SPEED_OF_SOUND_M_PER_S / self.maximum_frequency_hz
        for name, nodes in (("near_field_spacing_m", 8.0), ("room_spacing_m", 3.5)):
            largest = shortest_wave_m / nodes
            if getattr(self, name) > largest:
                raise ValueError(
                    f"{name.removesuffix('_m')}_mm = {1e3 * getattr(self, name):g} mm: fewer than "
                    f"{nodes:g} nodes per wavelength at maximum_frequency_hz = "
                    f"{self.maximum_frequency_hz:g} Hz; allowed up to {1e3 * largest:.4g} mm"
                )
        return self
