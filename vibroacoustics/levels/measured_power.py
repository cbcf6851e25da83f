"""Sound power of a machine from levels at recorded microphones, with K1 and K2 (ISO 3744:2010)."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.decibel import SILENCE_DB, energy_mean, energy_sum
from ..base.weighting import WEIGHTING
from ..study.sound_power import MINIMUM_BACKGROUND_MARGIN_DB
from .bands import Band, bands_between
from .sound_power import (
    LARGEST_ENVIRONMENT_CORRECTION_DB,
    background_correction_db,
    environment_correction,
    sound_power_level,
)

BANDS: Final[tuple[Band, ...]] = bands_between(3, 100.0, 10_000.0)
"""Frequency range of interest (3.15)."""
SURVEY_MARGIN_DB: Final = 3.0
"""Least margin of ISO 3746, grade 3."""
SURVEY_ENVIRONMENT_DB: Final = 7.0
"""Largest K2A of ISO 3746."""
SABINE_S_PER_M: Final = 0.16
"""Factor of the absorption area from volume and reverberation time (Annex A)."""


def reverberant_absorption_area_m2(volume_m3: float, reverberation_time_s: Array) -> Array:
    """A = 0.16 V/T, m² (Sabine; ISO 3744:2010, Annex A).

    Parameters
    ----------
    volume_m3 : volume of the test room
    reverberation_time_s : by band, of any shape
    """
    return np.asarray(SABINE_S_PER_M * volume_m3 / reverberation_time_s)


@dataclass(frozen=True)
class MeasuredPower:
    """Levels in dB by third octave, shape (band,), and of their A-weighted sums.

    Attributes
    ----------
    mean_db : energy mean over the positions
    margin_db : above the background; not a number where none was recorded
    background_db, environment_db : K1 and K2
    power_db : sound power level re 1 pW; not a number where nothing was measured
    has_environment : whether K2 is that of a stated room
    """

    mean_db: Array
    margin_db: Array
    background_db: Array
    environment_db: Array
    power_db: Array
    has_environment: bool = True

    @property
    def power_dba(self) -> float:
        """LWA from the bands (Annex E)."""
        return float(a_weighted_sum(self.power_db))

    @property
    def margin_dba(self) -> float:
        """Margin of the A-weighted sums; not a number where no background was recorded."""
        if np.isnan(self.margin_db).all():
            return float("nan")
        return float(a_weighted_sum(self.mean_db) - a_weighted_sum(self.mean_db - self.margin_db))

    @property
    def background_dba(self) -> float:
        """K1A."""
        corrected = self.mean_db - self.background_db
        return float(a_weighted_sum(self.mean_db) - a_weighted_sum(corrected))

    @property
    def environment_dba(self) -> float:
        """K2A."""
        before = self.mean_db - self.background_db
        return float(a_weighted_sum(before) - a_weighted_sum(before - self.environment_db))

    @property
    def missing(self) -> tuple[str, ...]:
        """Quantities that a grade of ISO 3744 or ISO 3746 needs and that were not measured."""
        background = ("background",) if np.isnan(self.margin_dba) else ()
        return background if self.has_environment else (*background, "K2")

    @property
    def grade(self) -> int | None:
        """2 (ISO 3744), 3 (ISO 3746) or neither, by K2A and the margin of the A-weighted sums.

        None without a recorded background and without a stated room; see `missing`.
        """
        if self.missing:
            return None
        limits = (
            (2, MINIMUM_BACKGROUND_MARGIN_DB, LARGEST_ENVIRONMENT_CORRECTION_DB),
            (3, SURVEY_MARGIN_DB, SURVEY_ENVIRONMENT_DB),
        )
        for grade, least, largest in limits:
            if self.margin_dba >= least and self.environment_dba <= largest:
                return grade
        return None


def measured_power(
    levels_db: Array,
    background_db: Array | None,
    surface_m2: float,
    absorption_area_m2: Array | None,
) -> MeasuredPower:
    """LW = mean Lp - K1 - K2 + 10 lg(S/S0) of every band (equations 12, 16 to 18 and A.2).

    Parameters
    ----------
    levels_db : shape (position, band), re 20 µPa; not a number in bands that were not measured
    background_db : level of the background without the machine; none where it was not recorded
    surface_m2 : area of the measurement surface
    absorption_area_m2 : absorption area of the room, shape (band,); none for a free field over the
        floor
    """
    mean = energy_mean(levels_db)
    margin, background = np.full_like(mean, np.nan), np.zeros_like(mean)
    if background_db is not None:
        margin = mean - energy_mean(background_db)
        background = background_correction_db(margin)
    environment = np.zeros_like(mean)
    if absorption_area_m2 is not None:
        environment = environment_correction(surface_m2, absorption_area_m2)
    power = sound_power_level(mean, surface_m2, background, environment)
    has_room = absorption_area_m2 is not None
    return MeasuredPower(mean, margin, background, environment, power, has_room)


def a_weighted_sum(levels_db: Array) -> Array:
    """A-weighted level of bands, from their levels without weighting; shape (...).

    Parameters
    ----------
    levels_db : in `BANDS`, shape (..., band); bands that are not a number count as silent
    """
    middle_hz = np.array([band.middle_hz for band in BANDS])
    weighted = np.asarray(levels_db) + WEIGHTING["A"](middle_hz)
    return energy_sum(np.where(np.isnan(weighted), SILENCE_DB, weighted), axis=-1)


def spread_dba(levels_db: Array) -> float:
    """Highest less lowest A-weighted level of the positions, dB.

    Where it exceeds the number of positions there are too few of them (ISO 3744).
    """
    return float(np.ptp(a_weighted_sum(levels_db)))
