"""What no source explains of a machine's sound: how it goes with speed and frequency."""

import numpy as np
from pydantic import Field

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..base.parameters import Parameters


class Remainder(Parameters):
    """Growth with speed and A-weighted third-octave spectrum of what is not modelled.

    The level grows by so many decibels for ten times the speed; the spectrum falls from its peak
    on both sides.
    """

    speed_growth_db: float = Field(default=30.0, ge=0.0, le=100.0)
    """For ten times the speed."""
    peak_frequency_hz: float = Field(default=1600.0, ge=100.0, le=10000.0)
    """Of the A-weighted spectrum in third octaves."""
    slope_db: float = Field(default=4.0, ge=0.0, le=30.0)
    """For each octave off the peak."""

    def speed_factor(self, speed_rpm: Array, published_rpm: float) -> Array:
        """Mean square at each speed over that at the speed of the published level."""
        tenfold = level_of_power(speed_rpm / published_rpm) / 10.0
        return power_of_level(self.speed_growth_db * tenfold)

    def spectrum(self, frequency_hz: Array) -> Array:
        """A-weighted mean square in third octaves over that at the peak."""
        octaves = np.abs(np.log2(frequency_hz / self.peak_frequency_hz))
        return power_of_level(-self.slope_db * octaves)
