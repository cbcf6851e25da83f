"""Bands of the draws: what the ranges of the assumed values leave open."""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import power_of_level
from ..base.vocabulary import REFERENCE_OPTION
from .study import has_draws


class Band(NamedTuple):
    """Lowest, middle and highest of the quantiles over the draws that are kept."""

    lowest: float
    middle: float
    highest: float

    def ends(self, write: Callable[[float], str]) -> str:
        """`44.7 to 51.2`."""
        return rounding.span((self.lowest, self.highest), write)

    def middle_and_ends(self, write: Callable[[float], str]) -> str:
        """`48.9 (44.7 to 51.2)`; the middle alone where nothing was drawn."""
        ends, middle = self.ends(write), write(self.middle)
        return middle if ends == middle else f"{middle} ({ends})"

    def share_of(self, level_db: float) -> "Band":
        """Energies of levels as shares of the energy of another; quantiles stay quantiles."""
        return Band(*(energy_share(level, level_db) for level in self))


QUANTILES: Final = (0.1, 0.5, 0.9)


def quantiles(results: xr.Dataset, name: str) -> xr.DataArray:
    """Quantiles of an A-weighted level or its change over the draws that count, (quantile, ...).

    Where nothing was drawn all are the value as given.

    Parameters
    ----------
    results : of a run
    name : `source_level`, `level_modelled`, `level_total`, `level_remainder`, `change_modelled`
        or `change_total`
    """
    if not has_draws(results):
        given = results[name]
        given = given.sel(weighting="A", drop=True) if "weighting" in given.dims else given
        return over_draws(results, given)
    level = results[f"{name.replace('change', 'level')}_by_draw"]
    if name.startswith("change"):
        level = level - level.sel(option=REFERENCE_OPTION, drop=True)
    return over_draws(results, level)


def over_draws(results: xr.Dataset, level: xr.DataArray) -> xr.DataArray:
    """Quantiles of a level over the draws that count, (quantile, ...); itself without draws."""
    if "draw" not in level.dims:
        return level.expand_dims(quantile=list(QUANTILES))
    counting = level.isel(draw=results["draw_weight"].values > 0.0)
    quantile: xr.DataArray = counting.quantile(QUANTILES, "draw")
    return quantile


def band(results: xr.Dataset, name: str, **at: Any) -> Band:
    """Band of a variable's quantiles at a speed, option, receiver or source."""
    return Band(*map(float, quantiles(results, name).sel(at).transpose("quantile").values))


def bands_by_speed(results: xr.Dataset, name: str, **at: Any) -> tuple[Band, ...]:
    """Bands of a variable's quantiles at every speed, at an option and a receiver."""
    rows = quantiles(results, name).sel(at).transpose("speed", "quantile").values
    return tuple(Band(*row) for row in rows.tolist())


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


def draws(results: xr.Dataset) -> tuple[int, int, int]:
    """Draws that are kept, those that alone exceed the overall level, those without solution."""
    kept = results["draw_weight"].values > 0.0
    levels = results["level_modelled_by_draw"].transpose("draw", ...).values
    unsolved = np.isnan(levels).reshape(kept.size, -1).any(axis=1)
    louder = ~kept & ~unsolved
    return int(kept.sum()), int(louder.sum()), int(unsolved.sum())


def band_words(results: xr.Dataset) -> str:
    """`10 to 90 % quantiles`."""
    return f"{100.0 * QUANTILES[0]:.0f} to {100.0 * QUANTILES[-1]:.0f} % quantiles"
