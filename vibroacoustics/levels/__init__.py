"""Levels: weightings, sums, bands, filter bank, time weighting, levels of recordings.

>>> time = np.arange(8000) / 8000.0
>>> pascal = np.sqrt(2.0) * np.sin(2.0 * np.pi * 1000.0 * time)
>>> va.levels.recorded_levels(pascal, 8000.0, 20e-6, "A").equivalent_db.round(1).item()
94.0
"""

from ..base.decibel import (
    SILENCE_DB,
    energy_difference,
    energy_mean,
    energy_sum,
    mean_square_level,
    sound_pressure_level,
)
from ..base.weighting import WEIGHTING, a_weighting, c_weighting, weighted_signal, z_weighting
from .bands import Band, band_mean_square, bands_between, measurable_bands
from .block_levels import block_levels
from .by_source import SourceSound, filled_thirds, source_sound
from .filter_bank import band_filter, band_signal, class_1_limits_db
from .labelled import level, level_variables
from .measured_power import reverberant_absorption_area_m2
from .signal_levels import (
    RecordedLevels,
    band_levels,
    equivalent_level,
    level_reference,
    recorded_levels,
)
from .time_weighting import (
    FAST_TIME_CONSTANT_S,
    SLOW_TIME_CONSTANT_S,
    time_weighted_mean_square,
)

__all__ = [
    "FAST_TIME_CONSTANT_S",
    "SILENCE_DB",
    "SLOW_TIME_CONSTANT_S",
    "WEIGHTING",
    "Band",
    "RecordedLevels",
    "SourceSound",
    "a_weighting",
    "band_filter",
    "band_levels",
    "band_mean_square",
    "band_signal",
    "bands_between",
    "block_levels",
    "c_weighting",
    "class_1_limits_db",
    "energy_difference",
    "energy_mean",
    "energy_sum",
    "equivalent_level",
    "filled_thirds",
    "level",
    "level_reference",
    "level_variables",
    "mean_square_level",
    "measurable_bands",
    "recorded_levels",
    "reverberant_absorption_area_m2",
    "sound_pressure_level",
    "source_sound",
    "time_weighted_mean_square",
    "weighted_signal",
    "z_weighting",
]
