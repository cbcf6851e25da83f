"""Growth of a compressor's level with speed: from levels of other machines at two speeds."""

from collections.abc import Collection, Iterable
from math import sqrt
from statistics import fmean
from typing import Final, NamedTuple

from ..base.decibel import level_of_power
from ..base.quantiles import NORMAL_90

ROUNDING_VARIANCE_DB2: Final = 2.0 / 12.0
"""Variance of a difference of two levels, each rounded to 1 dB."""
EVENLY: Final = 0.8
"""Share of an evenly sampled range that its 80 % interval covers."""


class LevelPair(NamedTuple):
    """Levels of one machine at two speeds, as printed."""

    slow_rpm: float
    slow_level_db: float
    fast_rpm: float
    fast_level_db: float

    @property
    def decades(self) -> float:
        """Ratio of the speeds, in powers of ten."""
        return level_of_power(self.fast_rpm / self.slow_rpm) / 10.0

    @property
    def growth_db(self) -> float:
        """Growth of the level for ten times the speed, dB."""
        return (self.fast_level_db - self.slow_level_db) / self.decades


class Growth(NamedTuple):
    """Expected growth of the level of a machine for ten times the speed, and its deviation, dB."""

    mean_db: float
    deviation_db: float

    def change_interval_db(self, pair: LevelPair) -> tuple[float, float]:
        """80 % interval of a printed change of level between the speeds of a pair, dB."""
        variance = (self.deviation_db * pair.decades) ** 2 + ROUNDING_VARIANCE_DB2
        middle, half = self.mean_db * pair.decades, NORMAL_90 * sqrt(variance)
        return middle - half, middle + half

    @property
    def range_db(self) -> tuple[float, float]:
        """Evenly sampled range with the same 80 % interval, dB; below zero a level falls."""
        half = NORMAL_90 * self.deviation_db / EVENLY
        return self.mean_db - half, self.mean_db + half


def growth_of_series(series: Collection[Collection[LevelPair]]) -> Growth:
    """Return what levels of other series let expect of a further machine.

    Each series counts alike. The variance is that of the printed growths about the mean of the
    series, with the error of rounding; the mean of J series adds its J-th part.

    Parameters
    ----------
    series : pairs of each, at least one
    """
    mean = fmean(fmean(pair.growth_db for pair in pairs) for pairs in series)
    variance = fmean(fmean(_square_about(mean, pairs)) for pairs in series)
    return Growth(mean, sqrt(variance * (1.0 + 1.0 / len(series))))


def growth_of_pair(pair: LevelPair) -> Growth:
    """Return the growth of a machine whose level is published at two speeds."""
    return Growth(pair.growth_db, sqrt(ROUNDING_VARIANCE_DB2) / abs(pair.decades))


def _square_about(mean_db: float, pairs: Iterable[LevelPair]) -> Iterable[float]:
    for pair in pairs:
        yield (pair.growth_db - mean_db) ** 2 + ROUNDING_VARIANCE_DB2 / pair.decades**2


SOURCE: Final = "computed from makers' levels at two speeds (data/validation/published_levels.csv)"
SCROLL_OR_SCREW: Final = Growth(28.2, 7.0)
"""Growth of the series SH, VLZ and SAB."""
RECIPROCATING: Final = Growth(35.1, 35.4)
"""Growth of the series NTZ with one, two and four cylinders."""
