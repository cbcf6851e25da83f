"""Unmodelled noise of a machine: its growth with speed and its spectrum."""

from math import inf
from typing import Annotated, Final, Literal

import numpy as np
from pydantic import Field

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..base.parameters import Contradictions, Held, Parameters, Regime

PRIOR: Final = Held("are the prior of unmodelled noise before anything is sampled")
LEAST_FLAT_DB: Final = 1.0
UNMODELLED_KEYS: Final = frozenset(
    f"remainder.{name}" for name in ("speed_growth_db", "peak_frequency_hz", "slope_db")
)
"""Keys without effect where a machine has no published level that leaves unmodelled noise."""
PEAKS: Final = (
    Regime("unmodelled noise with its peak up to 1 kHz", 0.0, 1000.0),
    Regime("unmodelled noise with its peak from 1 kHz", 1000.0, inf),
)
"""Halves, on a logarithm, of 250 Hz to 5 kHz."""
DATUM: Final = Held("are data that the model is compared to")


class SpectralShare(Parameters):
    """Share of the A-weighted energy of the machine below a frequency."""

    below_hz: Annotated[float, DATUM] = Field(ge=50.0, le=10000.0)
    share_ratio: Annotated[float, DATUM] = Field(ge=0.0, le=1.0)
    deviation_ratio: Annotated[float, DATUM] = Field(ge=0.01, le=1.0)
    """Standard deviation of the share."""


BIAS_DB: Final = {"measured": (0.0, 0.0), "declared": (2.5, 1.5), "series": (1.0, 2.0)}
"""Mean and standard deviation of the published level less that of the machine: K of a declared
level by ISO 4871 from 1.5 to 4 dB, the scatter of a series assumed."""


class OverallNoise(Parameters):
    """A-weighted sound pressure level of the machine, published or assumed."""

    level_dba: Annotated[float, DATUM] = Field(ge=0.0, le=140.0)
    speed_rpm: Annotated[float, DATUM] = Field(ge=60.0, le=60000.0)
    distance_m: Annotated[float, DATUM] = Field(ge=0.1, le=20.0)
    deviation_db: Annotated[float, DATUM] = Field(default=2.0, ge=0.1, le=10.0)
    """Standard deviation of the level."""
    kind: Literal["measured", "declared", "series"] = "measured"
    """A declared level is L + K of ISO 4871, that of a series one for many machines."""
    spectral_share: SpectralShare | None = None
    other_speed_rpm: Annotated[float | None, DATUM] = Field(default=None, ge=60.0, le=60000.0)
    """Second speed at which a level is published."""
    other_level_dba: Annotated[float | None, DATUM] = Field(default=None, ge=0.0, le=140.0)
    """Level at the second speed; both give the growth of unmodelled noise with speed."""

    @property
    def likely_level_dba(self) -> float:
        """Level of the machine that the published one stands for: less the bias of its kind."""
        return self.level_dba - BIAS_DB[self.kind][0]

    @property
    def likely_deviation_db(self) -> float:
        """Standard deviation of the level with that of the bias."""
        return float(np.hypot(self.deviation_db, BIAS_DB[self.kind][1]))

    def contradictions(self) -> Contradictions:
        if (self.other_speed_rpm is None) != (self.other_level_dba is None):
            yield "other_speed_rpm, other_level_dba: give both or none"
        if self.other_speed_rpm == self.speed_rpm:
            yield f"other_speed_rpm = {self.speed_rpm:g} rpm: must differ from speed_rpm"


class UnmodelledNoise(Parameters):
    """Growth with speed and A-weighted third-octave spectrum of unmodelled noise.

    The level grows by so many decibels for ten times the speed; the spectrum falls from its peak
    on both sides. Its level has two priors, each relative to the published level: one flat
    in dB between two limits, one near a level.
    """

    speed_growth_db: float = Field(default=30.0, ge=-100.0, le=200.0)
    """Growth for ten times the speed; below zero where a resonance makes the slower speed the
    louder."""
    peak_frequency_hz: Annotated[float, *PEAKS] = Field(default=1600.0, ge=100.0, le=10000.0)
    """Peak of the A-weighted spectrum in third octaves."""
    slope_db: float = Field(default=4.0, ge=0.0, le=30.0)
    """Slope for each octave off the peak."""
    flat_lowest_db: Annotated[float, PRIOR] = Field(default=-26.0, ge=-40.0, le=10.0)
    flat_highest_db: Annotated[float, PRIOR] = Field(default=4.0, ge=-40.0, le=10.0)
    near_level_db: Annotated[float, PRIOR] = Field(default=-2.0, ge=-30.0, le=5.0)
    near_deviation_db: Annotated[float, PRIOR] = Field(default=3.0, ge=0.5, le=20.0)

    def contradictions(self) -> Contradictions:
        if self.flat_highest_db - self.flat_lowest_db < LEAST_FLAT_DB:
            yield (
                f"flat_lowest_db = {self.flat_lowest_db:g} dB: must be at least "
                f"{LEAST_FLAT_DB:g} dB below flat_highest_db, {self.flat_highest_db:g} dB"
            )

    def speed_factor(self, speed_rpm: Array, published_rpm: float) -> Array:
        """Mean square at each speed over that at the speed of the published level."""
        tenfold = level_of_power(speed_rpm / published_rpm) / 10.0
        return power_of_level(self.speed_growth_db * tenfold)

    def spectrum(self, frequency_hz: Array) -> Array:
        """A-weighted mean square in third octaves, relative to their sum."""
        octaves = np.abs(np.log2(frequency_hz / self.peak_frequency_hz))
        spectrum = power_of_level(-self.slope_db * octaves)
        return np.asarray(spectrum / spectrum.sum())
