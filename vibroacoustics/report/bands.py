"""Bands of the draws: what the ranges of the assumed values leave open."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding


class Band(NamedTuple):
    """Lowest, middle and highest of the quantiles over the draws that are kept."""

    lowest: float
    middle: float
    highest: float

    def ends(self, write: Callable[[float], str]) -> str:
        """`44.7 to 51.2`."""
        return rounding.span((self.lowest, self.highest), write)

    def whole(self, write: Callable[[float], str]) -> str:
        """`48.9 (44.7 to 51.2)`; the middle alone where nothing was drawn."""
        ends, middle = self.ends(write), write(self.middle)
        return middle if ends == middle else f"{middle} ({ends})"

    def share_of(self, level_db: float) -> "Band":
        """Energies of levels as shares of the energy of another; quantiles stay quantiles."""
        return Band(*(energy_share(level, level_db) for level in self))


def band(results: xr.Dataset, name: str, **at: Any) -> Band:
    """Band of a variable's quantiles at a speed, option, receiver or source."""
    return Band(*map(float, results[f"{name}_quantile"].sel(at).transpose("quantile").values))


def energy_share(level_db: float, of_level_db: float) -> float:
    """Energy of a level as a share of another's."""
    return float(10.0 ** ((level_db - of_level_db) / 10.0))


def percent(share: float) -> str:
    """A share in percent, to two digits where it is small."""
    size = 100.0 * share
    if not np.isfinite(size):
        return rounding.NOTHING
    if abs(size) < 0.01:
        return "<\u00a00.01\u00a0%"
    number = rounding.fixed(size, 0) if abs(size) >= 10.0 else rounding.significant(size, 2)
    return f"{number}\u00a0%"


def draws(results: xr.Dataset) -> tuple[int, int]:
    """Draws that are kept, and those left out because they alone exceed the overall level."""
    attrs = results["source_level_quantile"].attrs
    louder = int(attrs["draws_above_overall_level"])
    return int(attrs["draws"]) - louder, louder


def band_words(results: xr.Dataset) -> str:
    """`10 to 90 % quantiles`."""
    quantiles = results["quantile"].values
    return f"{100.0 * quantiles[0]:.0f} to {100.0 * quantiles[-1]:.0f} % quantiles"
