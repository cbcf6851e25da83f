"""Shifts of one quantity by an option against the reference, as numbers and in words."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import amplitude_of_level
from ..base.remembered import remembered
from ..base.vocabulary import REFERENCE_OPTION
from ..results.bands import FINEST_RATIO, Band, band, hull, written
from ..results.estimates import Estimate, effective_samples, estimate, is_sampled
from ..results.stored_study import catalogue_receiver, parameters, speeds
from ..study.scoring import Measurable
from .columns import column
from .quantities import Quantity

_ALL: Final = 0.995
"""Probability that reads as one."""


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

    def short(self) -> str:
        """`1× force +22 to +24 %`, `total level +2.2 to +25.2 dB`, how often it is measurable."""
        if self.before.min() < self.quantity.floor:
            return f"{self.quantity.words} appears"
        size = f"{self.quantity.words} {self.size()}"
        share = self.grown if self.worsens else self.fallen
        return size if share > _ALL else f"{size} ({100.0 * share:.0f} % of samples)"

    def size(self) -> str:
        """`+22 to +24 %` of forces, `+2.2 to +25.2 dB` of levels: over samples and speeds."""
        return f"{self.written(extent([self]))} {self.unit}"

    def written(self, changes: Band) -> str:
        """`+22 to +24`, of changes in their unit."""
        decimals = 1 if self.quantity.is_level else 0
        return changes.ends(partial(rounding.signed, decimals=decimals))

    @property
    def unit(self) -> str:
        """Unit of a change."""
        return "dB" if self.quantity.is_level else "%"


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
    """Band of a change over the speeds and microphones of shifts of one quantity."""
    return hull([band for shifted in shifts for band in shifted.bands])


def measurable(results: xr.Dataset) -> Measurable:
    """Smallest changes that could be measured; files of older versions name none."""
    return Measurable(**parameters(results)["scoring"].get("measurable", {}))


def at_receiver(values: xr.DataArray, receiver: str) -> xr.DataArray:
    """The values at a microphone; forces have none and are returned as they are."""
    return values.sel(receiver=receiver) if "receiver" in values.dims else values
