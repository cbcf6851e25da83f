"""How an option shifts one quantity against the reference, as numbers and in words."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import amplitude_of_level, level_of_amplitude
from ..base.remembered import remembered
from ..base.vocabulary import REFERENCE_OPTION
from ..study.scoring import Measurable
from .bands import FINEST_DB, FINEST_RATIO, Band, band_of, has_band, hull, resampled
from .column_values import column
from .quantities import LINE, TOLERANCE_DB, Quantity
from .study import catalogue_receiver, parameters

_ALL: Final = 0.995
"""Share of the samples that reads as all of them."""


@dataclass(frozen=True)
class Shift:
    """A quantity at every speed, without a balancer and with one.

    Attributes
    ----------
    quantity : which
    before, after : nominal values, shape (speed,)
    sampled_db : change in each sample, shape (sample, speed); that of the nominal values where the
        quantity is not sampled
    weight : of the samples, of sum one
    least : smallest changes that could be measured
    weights : of bootstraps, shape (ensemble, sample); none where all samples are independent
    """

    quantity: Quantity
    before: Array
    after: Array
    sampled_db: Array
    weight: Array
    least: Measurable
    weights: Array | None = None

    @property
    def gain_db(self) -> Array:
        """Change at every speed in dB; values below the floor count as the floor."""
        return _gain(self.quantity, self.before, self.after)

    @property
    def worsens(self) -> bool:
        """Whether it grows by what could be measured in most samples, at a speed at least."""
        return self.grown > self.least.samples_ratio

    @property
    def improves(self) -> bool:
        """Whether it falls by what could be measured in most samples, at a speed at least."""
        return self.fallen > self.least.samples_ratio

    @property
    def grown(self) -> float:
        """Share of the samples in which it grows by what could be measured; of all speeds most."""
        return self._share(np.where(self._relative > self._threshold, 1.0, 0.0))

    @property
    def fallen(self) -> float:
        """Share of the samples in which it falls by what could be measured; of all speeds most."""
        return self._share(np.where(self._relative < -self._threshold, 1.0, 0.0))

    @property
    def _relative(self) -> Array:
        """Changes in dB of levels, as ratios of forces, shape (sample, speed)."""
        if self.quantity == LINE:
            quietest = self.least.quietest_line_db
            gain = np.maximum(self.after, quietest) - np.maximum(self.before, quietest)
            return np.asarray(gain[None])
        if self.quantity.is_level:
            return self.sampled_db
        return np.asarray(amplitude_of_level(self.sampled_db) - 1.0)

    @property
    def _threshold(self) -> float:
        least = self.least
        return least.level_db if self.quantity.is_level else least.force_ratio

    def _share(self, counts: Array) -> float:
        return float((self.weight @ counts).max())

    def short(self) -> str:
        """`1× force +22 to +24 %`, `total level +2.2 to +25.2 dB`, how often it is measurable."""
        if self.before.min() < self.quantity.floor:
            return f"{self.quantity.words} appears"
        size = f"{self.quantity.words} {self.size()}"
        share = self.grown if self.worsens else self.fallen
        if share > _ALL:
            return size
        return f"{size} (measurable in {100.0 * share:.0f} % of the samples at a speed)"

    def size(self) -> str:
        """`+22 to +24 %` of forces, `+2.2 to +25.2 dB` of levels: over samples and speeds."""
        return f"{self.written(extent([self]))} {self.unit}"

    def written(self, changes: Band) -> str:
        """`+22 to +24`, of changes in their unit."""
        return changes.ends(rounding.signed if self.quantity.is_level else _percent)

    @property
    def unit(self) -> str:
        """Unit of a change."""
        return "dB" if self.quantity.is_level else "%"

    @cached_property
    def bands(self) -> list[Band]:
        """Band of the change at every speed: dB of levels, % of forces."""
        changes, finest = self.sampled_db, FINEST_DB
        if not self.quantity.is_level:
            changes = np.asarray(100.0 * (amplitude_of_level(changes) - 1.0))
            finest = 100.0 * FINEST_RATIO
        return [band_of(changed, self.weight, self.weights, finest) for changed in changes.T]

    def sentence(self) -> str:
        """`grows by 81 % (to at most 120 N)` and the like, without the quantity's name."""
        gain = self.gain_db
        if abs(gain).max() <= TOLERANCE_DB:
            return "stays the same"
        if self.after.max() < self.quantity.floor:
            return f"vanishes (was up to {self.quantity.write(self.before.max())})"
        if self.before.min() < self.quantity.floor:
            return f"appears (at most {self.quantity.write(self.after.max())})"
        size = self._level_words() if self.quantity.is_level else self._ratio_words()
        return f"{size} (to at most {self.quantity.write(self.after.max())})"

    @property
    def _both_ways(self) -> bool:
        return bool(self.gain_db.max() > TOLERANCE_DB and self.gain_db.min() < -TOLERANCE_DB)

    def _level_words(self) -> str:
        gain = self.gain_db
        if self._both_ways:
            return f"changes by {rounding.span(gain, rounding.signed)} dB, depending on the speed"
        verb = "rises" if gain.max() > TOLERANCE_DB else "falls"
        return f"{verb} by {rounding.span(abs(gain), rounding.fixed)} dB"

    def _ratio_words(self) -> str:
        ratio = self.after / self.before
        if self._both_ways:
            change = rounding.span(100.0 * (ratio - 1.0), _percent)
            return f"changes by {change} %, depending on the speed"
        if ratio.max() >= 2.0:
            return f"grows {rounding.span(ratio, lambda value: rounding.fixed(value, 2))}-fold"
        verb = "grows" if ratio.max() > 1.0 else "falls"
        size = rounding.span(100.0 * abs(ratio - 1.0), lambda value: rounding.fixed(value, 0))
        return f"{verb} by {size} %"


@remembered
def shift(
    results: xr.Dataset, quantity: Quantity, option: str, receiver: str | None = None
) -> Shift:
    """The shift of a quantity by an option, at the catalogue's microphone if none is named."""
    at = receiver or catalogue_receiver(results)
    values = at_receiver(column(results, quantity.column), at)
    before = values.sel(option=REFERENCE_OPTION).values
    after = values.sel(option=option).values
    if quantity.sampled and has_band(results, quantity.sampled):
        sampled_db, weight, weights = _sampled_change(results, quantity, option, at)
    else:
        sampled_db, weight, weights = _gain(quantity, before, after)[None], np.ones(1), None
    return Shift(quantity, before, after, sampled_db, weight, measurable(results), weights)


def extent(shifts: Sequence[Shift]) -> Band:
    """Band of a change over the speeds and microphones of shifts of one quantity."""
    return hull([band for shifted in shifts for band in shifted.bands])


def measurable(results: xr.Dataset) -> Measurable:
    """Smallest changes that could be measured; files of older versions name none."""
    return Measurable(**parameters(results)["scoring"].get("measurable", {}))


def at_receiver(values: xr.DataArray, receiver: str) -> xr.DataArray:
    """The values at a microphone; forces have none and are returned as they are."""
    return values.sel(receiver=receiver) if "receiver" in values.dims else values


def _gain(quantity: Quantity, before: Array, after: Array) -> Array:
    before, after = np.maximum(before, quantity.floor), np.maximum(after, quantity.floor)
    gain = after - before if quantity.is_level else level_of_amplitude(after / before)
    return np.asarray(gain)


def _sampled_change(
    results: xr.Dataset, quantity: Quantity, option: str, receiver: str
) -> tuple[Array, Array, Array]:
    """Change in the samples that count, shape (sample, speed), dB, and their weights."""
    counting, weight, weights = _counting(results)
    sampled = at_receiver(results[f"{quantity.sampled}_by_sample"], receiver)
    before, after = (
        sampled.sel(option=name).transpose("sample", "speed").values[counting]
        for name in (REFERENCE_OPTION, option)
    )
    return _gain(quantity, before, after), weight, weights


@remembered
def _counting(results: xr.Dataset) -> tuple[Array, Array, Array]:
    """Which samples count, their weights of sum one, and those of their bootstraps."""
    weight = results["sample_weight"].values[0]
    counting = weight > 0.0
    of_counting = weight[counting]
    return counting, of_counting / of_counting.sum(), resampled(results, 0)[:, counting]


def _percent(value: float) -> str:
    return rounding.signed(value, 0)
