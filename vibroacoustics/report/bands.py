"""Bands of the draws: what the ranges of the assumed values leave open."""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import level_of_power, power_of_level
from ..base.quantiles import weighted_quantiles
from ..base.remembered import remembered
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.agreement import effective_samples
from .study import a_weighted, at_catalogue, has_draws, quoted_dba, quoted_speed


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


@remembered
def quantiles(results: xr.Dataset, name: str) -> xr.DataArray:
    """Quantiles of an A-weighted level or its change over the draws, (quantile, ...).

    Where nothing was drawn all are the value as given.

    Parameters
    ----------
    results : of a run
    name : `source_level`, `level_modelled`, `level_total`, `level_remainder`, `change_modelled`
        or `change_total`; `force_1x`, `moment_1x` or `foot_force_1x` where they were drawn
    """
    if not has_draws(results):
        return over_draws(results, a_weighted(results[name]))
    level = results[f"{name.replace('change', 'level')}_by_draw"]
    if name.startswith("change"):
        level = level - level.sel(option=REFERENCE_OPTION, drop=True)
    return over_draws(results, level)


def has_band(results: xr.Dataset, name: str) -> bool:
    """Whether a variable was drawn; names as of `quantiles`, and `force_1x` and the like."""
    return has_draws(results) and f"{name.replace('change', 'level')}_by_draw" in results


def over_draws(results: xr.Dataset, level: xr.DataArray, prior: int = 0) -> xr.DataArray:
    """Quantiles of a level over the draws by their weights, (quantile, ...); itself without draws.

    Parameters
    ----------
    results : with the weights
    level : by draw
    prior : number of the prior of the remainder
    """
    if "draw" not in level.dims:
        return level.expand_dims(quantile=list(QUANTILES))
    by_draw = level.transpose("draw", ...)
    weight = results["draw_weight"].values[prior]
    values = weighted_quantiles(by_draw.values, weight, QUANTILES)
    like = by_draw.isel(draw=0, drop=True).expand_dims(quantile=list(QUANTILES))
    return like.copy(data=values)


def band(results: xr.Dataset, name: str, **at: Any) -> Band:
    """Band of a variable's quantiles at a speed, option, receiver or source."""
    return Band(*map(float, quantiles(results, name).sel(at).transpose("quantile").values))


@remembered
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


def share_band(results: xr.Dataset, level: xr.DataArray, prior: int = 0) -> Band:
    """Energy of a level as a share of that of the whole machine where its level is published.

    Without draws of that of the published level; without one of that of all that is modelled.

    Parameters
    ----------
    results : of a run
    level : by draw, dB(A)
    prior : number of the prior of the remainder
    """
    if not has_draws(results):
        return Band(*map(float, over_draws(results, level).values)).share_of(quoted_dba(results))
    share = power_of_level(level - total_by_draw(results, prior))
    return Band(*map(float, over_draws(results, share, prior).values))


@remembered
def total_by_draw(results: xr.Dataset, prior: int) -> xr.DataArray:
    """Level of the whole machine without an option at the published speed, (draw,), dB(A)."""
    at = at_catalogue(results, speed=quoted_speed(results))
    modelled = power_of_level(results["level_modelled_by_draw"].sel(at))
    rest = power_of_level(results["level_remainder_by_draw"])
    return level_of_power(modelled + rest)


class Draws(NamedTuple):
    """How many draws there are.

    Attributes
    ----------
    tried : at the point of the published level
    effective : of them, by how well they agree with it
    computed : that went on
    unsolved : of these, without solution
    """

    tried: int
    effective: float
    computed: int
    unsolved: int


def draws(results: xr.Dataset) -> Draws:
    """How many draws the bands rest on."""
    weight = results["bank_weight"].values[0]
    effective = effective_samples(weight)
    if not has_draws(results):
        return Draws(weight.size, effective, 0, 0)
    levels = results["level_modelled_by_draw"].transpose("draw", ...).values
    unsolved = np.isnan(levels).reshape(len(levels), -1).any(axis=1)
    values = results["drawn_value"].transpose("draw", ...).values
    computed = (len(np.unique(values[rows], axis=0)) for rows in (slice(None), unsolved))
    return Draws(weight.size, effective, *computed)


def band_words(results: xr.Dataset) -> str:
    """`10 to 90 % quantiles`."""
    return f"{100.0 * QUANTILES[0]:.0f} to {100.0 * QUANTILES[-1]:.0f} % quantiles"
