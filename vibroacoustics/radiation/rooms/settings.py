"""Resolution and length of the computation of a room, and the pulse that drives it."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array

LEAST_NODES_PER_WAVE: Final = 3.5
LARGEST_SPACING_M: Final = 0.128
"""Largest spacing: flat L-, U- and T-shaped rooms with blocks of at least 1.1 m have their natural
frequencies within 0.1 %, with waves to 355, 710 and 1000 Hz (T: 1000 Hz)."""
SAMPLES_PER_PERIOD: Final = 3.0
"""Samples of what is recorded, at the highest frequency: the pulse has next to nothing at twice
that."""
STEPS_PER_PERIOD: Final = 10.0
"""Steps at the highest frequency, at least: with 8 a wall of 0.8 takes 0.0055 too much. Rooms with
furniture are stable with about as many only."""


@dataclass(frozen=True)
class RoomSettings:
    """Resolution and length of the computation of a room."""

    maximum_frequency_hz: float = 1000.0
    nodes_per_wave: float | None = None
    """Nodes at the highest frequency; None: 3.5, more in rooms to less than 765 Hz."""
    decay_db: float = 60.0
    """A run ends when the pressure at its points has fallen by so much."""
    longest_s: float | None = None
    """Longest record; None: the reverberation time."""

    @property
    def wavelength_m(self) -> float:
        """Wavelength at the highest frequency."""
        return SPEED_OF_SOUND_M_PER_S / self.maximum_frequency_hz

    @property
    def spacing_m(self) -> float:
        """Largest spacing of nodes."""
        if self.nodes_per_wave is not None:
            return self.wavelength_m / self.nodes_per_wave
        return min(self.wavelength_m / LEAST_NODES_PER_WAVE, LARGEST_SPACING_M)

    @property
    def longest_step_s(self) -> float:
        """Longest step with which walls keep their impedance: see `stepped_branches`."""
        return 1.0 / (STEPS_PER_PERIOD * self.maximum_frequency_hz)

    def sampling_steps(self, time_step_s: float) -> int:
        """Time steps between samples of what is recorded."""
        rate = SAMPLES_PER_PERIOD * self.maximum_frequency_hz
        return max(1, int(1.0 / (rate * time_step_s) + 1e-9))

    def force(self, time_step_s: float) -> tuple[Array, Array]:
        """Times and values of the pulse, (time,)."""
        count = int(np.ceil(4.5 / (0.45 * self.maximum_frequency_hz) / time_step_s))
        time = time_step_s * np.arange(count)
        return time, ricker(time, self.maximum_frequency_hz)


def ricker(time_s: Array, maximum_frequency_hz: float) -> Array:
    """Pulse of zero mean with its peak at 0.45 of the highest frequency, (time,).

    N. Ricker, "The form and laws of propagation of seismic wavelets", Geophysics 18 (1953).
    A pulse with a mean would leave a static pressure in a hard room.
    """
    peak_hz = 0.45 * maximum_frequency_hz
    argument = (np.pi * peak_hz * (time_s - 2.25 / peak_hz)) ** 2
    return np.asarray((1.0 - 2.0 * argument) * np.exp(-argument))
