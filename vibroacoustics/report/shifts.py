"""How an option shifts one quantity against the reference, as numbers and in words."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.vocabulary import REFERENCE_OPTION
from .comparison import column
from .study import catalogue_receiver

NO_BREAK: Final = "\u00a0"

TOLERANCE_DB: Final = 0.05
"""Smaller changes count as none."""


HEARD_DB: Final = 1.0
"""A change of the total below about 1 dB is not heard, even side by side."""


@dataclass(frozen=True)
class Quantity:
    """A column of the comparison, and how a sentence calls it."""

    column: str
    words: str
    unit: str

    @property
    def is_level(self) -> bool:
        return self.unit.startswith("dB")

    @property
    def floor(self) -> float:
        """Values below are silence, or rounding errors."""
        return rounding.LEVEL_FLOOR_DB if self.is_level else rounding.FORCE_FLOOR

    def write(self, value: float) -> str:
        """The value with its unit, rounded, kept on one line."""
        number = rounding.level(value) if self.is_level else rounding.significant(value)
        return f"{number} {self.unit}".replace(" ", NO_BREAK)


FORCE: Final = Quantity("force_1x_n", "1× force", "N")
MOMENT: Final = Quantity("moment_1x_nm", "1× moment", "N m")
FOOT_FORCE: Final = Quantity("foot_force_1x_n", "1× foot force", "N")
LINE: Final = Quantity("level_1x_db", "1× line", "dB")
MODELLED: Final = Quantity("level_modelled_dba", "modelled level", "dB(A)")
TOTAL: Final = Quantity("level_total_dba", "total level", "dB(A)")

JUDGED: Final = (FORCE, MOMENT, FOOT_FORCE, MODELLED, LINE)
"""An option is called better or worse by these."""


@dataclass(frozen=True)
class Shift:
    """A quantity at every speed, without a balancer and with one."""

    quantity: Quantity
    before: Array
    after: Array

    @property
    def gain_db(self) -> Array:
        """Change at every speed in dB; values below the floor count as the floor."""
        floor = self.quantity.floor
        before, after = np.maximum(self.before, floor), np.maximum(self.after, floor)
        gain = after - before if self.quantity.is_level else level_of_amplitude(after / before)
        return np.asarray(gain)

    @property
    def worsens(self) -> bool:
        return bool(self.gain_db.max() > TOLERANCE_DB)

    @property
    def improves(self) -> bool:
        return bool(self.gain_db.min() < -TOLERANCE_DB)

    def sentence(self) -> str:
        """`grows by 81 % (to at most 120 N)` and the like, without the quantity's name."""
        if not (self.worsens or self.improves):
            return "stays the same"
        if self.after.max() < self.quantity.floor:
            return f"vanishes (was up to {self.quantity.write(self.before.max())})"
        if self.before.min() < self.quantity.floor:
            return f"appears (at most {self.quantity.write(self.after.max())})"
        size = self._level_words() if self.quantity.is_level else self._ratio_words()
        return f"{size} (to at most {self.quantity.write(self.after.max())})"

    def _level_words(self) -> str:
        gain = self.gain_db
        if self.worsens and self.improves:
            return f"changes by {rounding.span(gain, rounding.signed)} dB, depending on the speed"
        verb = "rises" if self.worsens else "falls"
        return f"{verb} by {rounding.span(abs(gain), rounding.fixed)} dB"

    def _ratio_words(self) -> str:
        ratio = self.after / self.before
        if self.worsens and self.improves:
            change = rounding.span(100.0 * (ratio - 1.0), lambda value: rounding.signed(value, 0))
            return f"changes by {change} %, depending on the speed"
        if ratio.max() >= 2.0:
            return f"grows {rounding.span(ratio, lambda value: rounding.fixed(value, 2))}-fold"
        verb = "grows" if self.worsens else "falls"
        size = rounding.span(100.0 * abs(ratio - 1.0), lambda value: rounding.fixed(value, 0))
        return f"{verb} by {size} %"


def shift(
    results: xr.Dataset, quantity: Quantity, option: str, receiver: str | None = None
) -> Shift:
    """The shift of a quantity by an option, at the catalogue's microphone if none is named."""
    values = at_receiver(column(results, quantity.column), receiver or catalogue_receiver(results))
    return Shift(
        quantity, values.sel(option=REFERENCE_OPTION).values, values.sel(option=option).values
    )


def at_receiver(values: xr.DataArray, receiver: str) -> xr.DataArray:
    """The values at a microphone; forces have none and are returned as they are."""
    return values.sel(receiver=receiver) if "receiver" in values.dims else values
