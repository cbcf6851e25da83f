"""Values with their 80 % intervals, to the digits that the number of samples allows."""

from collections.abc import Callable, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import power_of_level
from ..base.vocabulary import MEDIAN_STEP, VARIABLES
from . import number as numbers
from .estimates import Estimate, effective_samples, estimate, is_sampled
from .number import Number
from .stored_study import catalogue_receiver

Units = tuple[float, float, float]
"""Powers of ten to which lower end, value and upper end are written; 0 of nominal values."""
NOT_SAMPLED: Final = (0.0, 0.0, 0.0)
FINEST_DB: Final = 0.1
FINEST_RATIO: Final = 0.01
"""Least relative error of an amount, least error of a share."""
_END_ERROR: Final = 0.667
_MEDIAN_ERROR: Final = 0.489
"""Standard errors of a quantile at 10 or 90 % and of the median, over the width of the interval
between 10 and 90 % and the root of the number of samples, of a normal distribution."""
INTERVAL: Final = "80 % interval"


class Band(NamedTuple):
    """Value with the ends of its interval, and their units."""

    lowest: float
    middle: float
    highest: float
    units: Units = NOT_SAMPLED

    def ends(self, write: Callable[[float], str]) -> str:
        """`44.7 to 51.2`."""
        return rounding.span((self.lowest, self.highest), write, self.units[::2])

    def around_middle(self, write: Callable[[float], str]) -> str:
        """`44.7 to 51.2`; `to 51.2` or `from 44.7` where one end reads as the value, empty for two.

        The value is never given as an end of its own interval because of rounding.
        """
        low, high = (
            rounding.to_unit(end, unit, write)
            for end, unit in ((self.lowest, self.units[0]), (self.highest, self.units[2]))
        )
        if low == high:
            return ""
        middle = self.middle_text(write)
        lowest, value, highest = map(_rounded, self[:3], self.units)
        if low == middle or lowest > value:
            return f"to {high}"
        return f"from {low}" if high == middle or highest < value else self.ends(write)

    def middle_and_ends(self, write: Callable[[float], str]) -> str:
        """`48.9 (44.7 to 51.2)`; the value alone where both ends read the same."""
        around, middle = self.around_middle(write), self.middle_text(write)
        return f"{middle} ({around})" if around else middle

    def middle_text(self, write: Callable[[float], str]) -> str:
        """`48.9`."""
        return rounding.to_unit(self.middle, self.units[1], write)

    def as_part_of(self, total: "Band") -> "Band":
        """Return the band in the total's units where rounding alone puts it above the total.

        A part has less energy than its total in every sample, so that the total limits its error.
        """
        units = [
            total_unit
            if value <= limit and _rounded(value, unit) > _rounded(limit, total_unit)
            else unit
            for value, unit, limit, total_unit in zip(
                self[:3], self.units, total[:3], total.units, strict=True
            )
        ]
        low, middle, high = units
        return self._replace(units=(low, middle, high))

    def in_percent(self) -> str:
        """`20 % (3 % to 59 %)`, of shares."""
        small = [0.0 < share < 0.5 * FINEST_RATIO for share in self[:3]]
        low, middle, high = (
            0.0 if is_small else unit for is_small, unit in zip(small, self.units, strict=True)
        )
        return self._replace(units=(low, middle, high)).middle_and_ends(_whole_percent)


def _rounded(value: float, unit: float) -> float:
    return unit * np.round(value / unit) if unit else value


def fixed(value: Estimate) -> str:
    """Return the text of an estimate without its interval."""
    return rounding.fixed(value.value)


def band(results: xr.Dataset, name: str, **labels: Any) -> Band:
    """Return the value of a variable with its interval.

    A-weighted and at the microphone of the published level where no other labels are given.
    """
    selection = {"weighting": "A", "receiver": catalogue_receiver(results), **labels}
    value = estimate(results, name, **selection)
    if not is_sampled(results, name) or VARIABLES[name].statistic == MEDIAN_STEP:
        return Band(*value)
    is_level = name.startswith(("level", "change", "source_level", "residual", "rating_level"))
    return written(value, effective_samples(results), FINEST_DB if is_level else None)


def number(
    results: xr.Dataset, name: str, write: Callable[[float], str], unit: str = "", **labels: Any
) -> Number:
    """Return the value of a variable as a number; its text has the interval in brackets.

    The unit is that of the vocabulary where none is given; labels are those of `band`.
    """
    selection = {"weighting": "A", "receiver": catalogue_receiver(results), **labels}
    text = band(results, name, **labels).middle_and_ends(write)
    return numbers.number(results, name, lambda _: text, unit, **selection)


def written(value: Estimate, effective: float, finest: float | None = None) -> Band:
    """Return a band with the digits that the effective number of samples allows.

    `finest` is the least standard error that sets the digits; None for that of an amount.
    """
    least = FINEST_RATIO * abs(value.value) if finest is None else finest
    width = (value.high - value.low) / np.sqrt(max(effective, 1.0))
    errors = [factor * width for factor in (_END_ERROR, _MEDIAN_ERROR, _END_ERROR)]
    if not np.isfinite(width) or width == 0.0:
        return Band(*value)
    low, middle, high = (rounding.unit_of_digits(error, least) for error in errors)
    return Band(*value, (low, middle, high))


def hull(bands: Sequence[Band]) -> Band:
    """Lowest and highest of the ends of several bands; those that are not numbers do not count."""
    finite = [band for band in bands if np.isfinite([band.lowest, band.highest]).all()] or bands
    low = min(finite, key=lambda band: band.lowest)
    high = max(finite, key=lambda band: band.highest)
    units = (low.units[0], high.units[1], high.units[2])
    return Band(low.lowest, high.middle, high.highest, units)


def energy_share(level_db: float, of_level_db: float) -> float:
    """Energy of a level as a share of another's."""
    return power_of_level(level_db - of_level_db)


def percent(share: float) -> str:
    """A share in percent, to two digits where it is small."""
    size = 100.0 * share
    if not np.isfinite(size):
        return rounding.NOTHING
    if abs(size) < 0.01:
        return "<\u00a00.01\u00a0%"
    number = rounding.fixed(size, 0) if abs(size) >= 10.0 else rounding.significant(size, 2)
    return f"{number}\u00a0%"


def _whole_percent(share: float) -> str:
    """A share in percent without decimals; one that rounds to none, but is some, is `<1 %`."""
    if 0.0 < share < 0.5 * FINEST_RATIO:
        return "<1\u00a0%"
    return f"{rounding.fixed(100.0 * share, 0)}\u00a0%"
