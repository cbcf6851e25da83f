"""Shifts of one quantity by an option against the reference, as numbers and in words."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final, Literal

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import amplitude_of_level
from ..base.remembered import remembered
from ..base.vocabulary import REFERENCE_OPTION
from ..results.bands import FINEST_RATIO, Band, band, hull, written
from ..results.estimates import QUANTILES, Estimate, effective_samples, estimate, is_sampled
from ..results.stored_study import catalogue_receiver, parameters, speeds
from ..study.scoring import Measurable
from .columns import column
from .quantities import Quantity

_ALL: Final = 0.995
"""Probability that reads as one."""
UNSURE: Final = QUANTILES[0]
"""Probability of a measurable change from which on it is not said that there is none."""


@dataclass(frozen=True)
class Shift:
    """A quantity at every speed, without a balancer and with one.

    Attributes
    ----------
    quantity : which
    before, after : values, shape (speed,)
    gain_db : change at every speed, shape (speed,), dB
    bands : intervals of the change at every speed: dB of levels, % of forces
    grown, fallen : probability of a change by what could be measured, at the speed where it is
        largest
    least : smallest changes that could be measured
    """

    quantity: Quantity
    before: Array
    after: Array
    gain_db: Array
    bands: tuple[Band, ...]
    grown: float
    fallen: float
    least: Measurable

    @property
    def worsens(self) -> bool:
        """Whether it grows by what could be measured in most samples, at a speed at least."""
        return self.grown > self.least.samples_ratio

    @property
    def improves(self) -> bool:
        """Whether it falls by what could be measured in most samples, at a speed at least."""
        return self.fallen > self.least.samples_ratio

    @property
    def rises(self) -> bool:
        """Whether it worsens, and where it grows most all of the interval can be measured."""
        return self.worsens and not self.bands[self._most].lowest < self._measurable

    @property
    def falls(self) -> bool:
        """Whether it improves, and where it falls most all of the interval can be measured."""
        return self.improves and not self.bands[self._least].highest > -self._measurable

    @property
    def is_uncertain(self) -> bool:
        """Whether one sample in ten or more changes measurably, but no change is sure."""
        return not (self.rises or self.falls) and max(self.grown, self.fallen) > UNSURE

    @property
    def largest(self) -> int:
        """Number of the speed at which it changes most, in the way that is said.

        A quantity that worsens is shown where it grows most, one that improves where it falls most.
        """
        if self.worsens != self.improves:
            return self._most if self.worsens else self._least
        return int(np.argmax(np.abs(np.nan_to_num(self.gain_db))))

    @property
    def band(self) -> Band:
        """Interval of the change at the speed where it is largest."""
        return self.bands[self.largest]

    @property
    def _most(self) -> int:
        return int(np.argmax(np.nan_to_num(self.gain_db)))

    @property
    def _least(self) -> int:
        return int(np.argmin(np.nan_to_num(self.gain_db)))

    @property
    def _measurable(self) -> float:
        is_level = self.quantity.is_level
        return self.least.level_db if is_level else 100.0 * self.least.force_ratio

    def short(self, *, better: bool) -> str:
        """`1× force +22 to +24 %` where it changes most to the better or worse, and how often."""
        if self.before.min() < self.quantity.floor:
            return f"{self.quantity.words} appears"
        size = self.written(self.bands[self._least if better else self._most])
        share = self.fallen if better else self.grown
        text = f"{self.quantity.words} {size} {self.unit}"
        return text if share > _ALL else f"{text} ({100.0 * share:.0f} % of samples)"

    def written(self, changes: Band) -> str:
        """`+22 to +24`, of changes in their unit."""
        decimals = 1 if self.quantity.is_level else 0
        return changes.ends(partial(rounding.signed, decimals=decimals))

    @property
    def unit(self) -> str:
        """Unit of a change."""
        return "dB" if self.quantity.is_level else "%"


def level_word(of_total: Shift) -> Literal["louder", "quieter", "uncertain", "no change"]:
    """Return what an option does to the level: the verdict of every part of a report."""
    if of_total.rises and not of_total.improves:
        return "louder"
    if of_total.falls and not of_total.worsens:
        return "quieter"
    sure = of_total.rises or of_total.falls
    return "uncertain" if sure or of_total.is_uncertain else "no change"


@remembered
def shift(
    results: xr.Dataset, quantity: Quantity, option: str, receiver: str | None = None
) -> Shift:
    """Return the shift of a quantity by an option, at the published microphone if none is named."""
    receiver_name = receiver or catalogue_receiver(results)
    values = at_receiver(column(results, quantity.column), receiver_name)
    bands, gain_db = _changes(results, quantity, option, receiver_name)
    chance = {
        name: results[f"{name}_probability"]
        .sel(judged_quantity=quantity.judged, option=option, receiver=receiver_name)
        .max()
        .item()
        for name in ("increase", "decrease")
    }
    return Shift(
        quantity,
        values.sel(option=REFERENCE_OPTION).values,
        values.sel(option=option).values,
        gain_db,
        bands,
        chance["increase"],
        chance["decrease"],
        measurable(results),
    )


def _changes(
    results: xr.Dataset, quantity: Quantity, option: str, receiver: str
) -> tuple[tuple[Band, ...], Array]:
    """Bands of the change at every speed, and the change in dB."""
    coordinates = {"option": option, "receiver": receiver}
    changes = [
        estimate(results, quantity.change, speed=speed, **coordinates) for speed in speeds(results)
    ]
    gain_db = np.array([change.value for change in changes])
    if quantity.is_level:
        each = (
            band(results, quantity.change, speed=speed, **coordinates) for speed in speeds(results)
        )
        return tuple(each), gain_db
    ratios = [
        Estimate(*(100.0 * (amplitude_of_level(end) - 1.0) for end in change)) for change in changes
    ]
    if not is_sampled(results, quantity.change):
        return tuple(Band(*ratio) for ratio in ratios), gain_db
    effective = effective_samples(results)
    return tuple(written(ratio, effective, 100.0 * FINEST_RATIO) for ratio in ratios), gain_db


def extent(shifts: Sequence[Shift]) -> Band:
    """Band over the microphones of shifts of one quantity, each where its change is largest."""
    return hull([shifted.band for shifted in shifts])


def measurable(results: xr.Dataset) -> Measurable:
    """Smallest changes that could be measured; files of older versions name none."""
    return Measurable(**parameters(results)["scoring"].get("measurable", {}))


def at_receiver(values: xr.DataArray, receiver: str) -> xr.DataArray:
    """The values at a microphone; forces have none and are returned as they are."""
    return values.sel(receiver=receiver) if "receiver" in values.dims else values
