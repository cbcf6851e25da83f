"""Bands of the samples: what the ranges of the assumed values leave open."""

from collections.abc import Callable, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..base.quantiles import weighted_quantiles
from ..base.remembered import remembered
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.agreement import effective_samples
from ..uncertainty.interval_digits import bootstrap_weights, quantile_errors
from .study import a_weighted, at_catalogue, has_samples, quoted_dba, quoted_speed

Units = tuple[float, float, float]
"""Powers of ten to which lowest, middle and highest are written; 0 where nothing was sampled."""
NOT_SAMPLED: Final = (0.0, 0.0, 0.0)


class Band(NamedTuple):
    """Lowest, middle and highest of the quantiles over the samples, and their units."""

    lowest: float
    middle: float
    highest: float
    units: Units = NOT_SAMPLED

    def ends(self, write: Callable[[float], str]) -> str:
        """`44.7 to 51.2`."""
        return rounding.span((self.lowest, self.highest), write, self.units[::2])

    def middle_and_ends(self, write: Callable[[float], str]) -> str:
        """`48.9 (44.7 to 51.2)`; the middle alone where nothing was sampled."""
        ends, middle = self.ends(write), self.middle_text(write)
        return middle if ends == middle else f"{middle} ({ends})"

    def middle_text(self, write: Callable[[float], str]) -> str:
        """`48.9`."""
        return rounding.to_unit(self.middle, self.units[1], write)

    def in_percent(self) -> str:
        """`20 % (3 % to 59 %)`, of shares."""
        small = [0.0 < share < 0.5 * FINEST_RATIO for share in self[:3]]
        low, middle, high = (
            0.0 if is_small else unit for is_small, unit in zip(small, self.units, strict=True)
        )
        return self._replace(units=(low, middle, high)).middle_and_ends(_whole_percent)

    def share_of(self, level_db: float) -> "Band":
        """Energies of levels as shares of the energy of another; quantiles stay quantiles."""
        lowest, middle, highest = (energy_share(level, level_db) for level in self[:3])
        return Band(lowest, middle, highest)


QUANTILES: Final = (0.1, 0.5, 0.9)
FINEST_DB: Final = 0.1
FINEST_RATIO: Final = 0.01
"""Least relative error of an amount, least error of a share."""


@remembered
def quantiles(results: xr.Dataset, name: str) -> xr.DataArray:
    """Quantiles of an A-weighted level or its change over the samples, (quantile, ...).

    Where nothing was sampled all are the nominal value.

    Parameters
    ----------
    results : of a run
    name : `source_level`, `level_modelled`, `level_total`, `level_unmodelled`, `change_modelled`
        or `change_total`; `force_1x`, `moment_1x` or `foot_force_1x` where they were sampled
    """
    return over_samples(results, _by_sample(results, name))


@remembered
def _by_sample(results: xr.Dataset, name: str) -> xr.DataArray:
    """A variable by sample, its nominal value without samples; names as of `quantiles`."""
    if not has_samples(results):
        return a_weighted(results[name])
    level = results[f"{name.replace('change', 'level')}_by_sample"]
    if name.startswith("change"):
        level = level - level.sel(option=REFERENCE_OPTION, drop=True)
    return level


def has_band(results: xr.Dataset, name: str) -> bool:
    """Whether a variable was sampled; names as of `quantiles`, and `force_1x` and the like."""
    return has_samples(results) and f"{name.replace('change', 'level')}_by_sample" in results


def over_samples(results: xr.Dataset, level: xr.DataArray, prior: int = 0) -> xr.DataArray:
    """Quantiles of a level over the weighted samples, (quantile, ...); itself without samples.

    Parameters
    ----------
    results : with the weights
    level : by sample
    prior : number of the prior of unmodelled noise
    """
    if "sample" not in level.dims:
        return level.expand_dims(quantile=list(QUANTILES))
    by_sample = level.transpose("sample", ...)
    weight = results["sample_weight"].values[prior]
    values = weighted_quantiles(by_sample.values, weight, QUANTILES)
    like = by_sample.isel(sample=0, drop=True).expand_dims(quantile=list(QUANTILES))
    return like.copy(data=values)


def band_over(
    results: xr.Dataset, values: xr.DataArray, finest: float | None = FINEST_DB, prior: int = 0
) -> Band:
    """Band of a value over the samples, to the digits that their number allows.

    Parameters
    ----------
    results : with the weights
    values : shape (sample,), or the nominal value
    finest : least standard error that sets the digits; none for that of an amount
    prior : number of the prior of unmodelled noise
    """
    return _band_of_samples(results, values.values, finest, prior)


def _band_of_samples(
    results: xr.Dataset, values: Array, finest: float | None, prior: int = 0
) -> Band:
    if values.ndim == 0:
        nominal = float(values)
        return Band(nominal, nominal, nominal)
    weight = results.variables["sample_weight"].values[prior]
    return band_of(values, weight, resampled(results, prior), finest)


def band_of(
    values: Array, weight: Array, weights: Array | None = None, finest: float | None = None
) -> Band:
    """Band of weighted values.

    Parameters
    ----------
    values, weight : shape (sample,)
    weights : of bootstraps, shape (ensemble, sample); none where all samples are independent
    finest : least standard error that sets the digits; none for that of an amount
    """
    lowest, middle, highest = map(float, weighted_quantiles(values, weight, QUANTILES))
    if weights is None:
        weights = bootstrap_weights(weight, np.arange(weight.size))
    least = FINEST_RATIO * abs(middle) if finest is None else finest
    errors = quantile_errors(values, weight, weights, QUANTILES).tolist()
    low, mid, high = (rounding.unit_of_digits(error, least) for error in errors)
    return Band(lowest, middle, highest, (low, mid, high))


@remembered
def resampled(results: xr.Dataset, prior: int) -> Array:
    """Weights of bootstraps, (ensemble, sample); what has the same values is chosen together."""
    values = results["sampled_value"].transpose("sample", ...).values
    _, sample = np.unique(values, axis=0, return_inverse=True)
    return bootstrap_weights(results["sample_weight"].values[prior], sample.ravel())


@remembered
def band(results: xr.Dataset, name: str, **at: Any) -> Band:
    """Band of a variable at a speed, option, source and, where it depends on it, a receiver."""
    samples, positions = _samples_and_positions(results, name)
    cell = tuple(position[at[dim]] for dim, position in positions.items())
    is_level = name.startswith(("level", "change", "source_level"))
    return _band_of_samples(results, samples[cell], FINEST_DB if is_level else None)


@remembered
def _samples_and_positions(
    results: xr.Dataset, name: str
) -> tuple[Array, dict[str, dict[Any, int]]]:
    """Values by sample, samples last, and the position of each coordinate by dimension."""
    samples = _by_sample(results, name)
    samples = samples.transpose(..., "sample", missing_dims="ignore")
    dims = [str(dim) for dim in samples.dims if dim != "sample"]
    positions = {
        dim: {key: n for n, key in enumerate(samples[dim].values.tolist())} for dim in dims
    }
    return samples.values, positions


def bands_by_speed(results: xr.Dataset, name: str, **at: Any) -> tuple[Band, ...]:
    """Bands of a variable at every speed, at an option and a receiver."""
    return tuple(band(results, name, speed=speed, **at) for speed in results["speed"].values)


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


def share_band(results: xr.Dataset, level: xr.DataArray, prior: int = 0) -> Band:
    """Energy of a level as a share of that of the whole machine where its level is published.

    Without samples of that of the published level; without one of that of all that is modelled.

    Parameters
    ----------
    results : of a run
    level : by sample, dB(A)
    prior : number of the prior of unmodelled noise
    """
    if not has_samples(results):
        return band_over(results, level).share_of(quoted_dba(results))
    share = power_of_level(level - total_by_sample(results, prior))
    return band_over(results, share, FINEST_RATIO, prior)


@remembered
def total_by_sample(results: xr.Dataset, prior: int) -> xr.DataArray:
    """Level of the whole machine without an option at the published speed, (sample,), dB(A)."""
    at = at_catalogue(results, speed=quoted_speed(results))
    modelled = power_of_level(results["level_modelled_by_sample"].sel(at))
    rest = power_of_level(results["level_unmodelled_by_sample"])
    return level_of_power(modelled + rest)


class Samples(NamedTuple):
    """How many samples there are.

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


def sample_values(results: xr.Dataset) -> Samples:
    """How many samples the bands rest on."""
    weight = results["prior_sample_weight"].values[0]
    effective = effective_samples(weight)
    if not has_samples(results):
        return Samples(weight.size, effective, 0, 0)
    levels = results["level_modelled_by_sample"].transpose("sample", ...).values
    unsolved = np.isnan(levels).reshape(len(levels), -1).any(axis=1)
    values = results["sampled_value"].transpose("sample", ...).values
    computed = (len(np.unique(values[rows], axis=0)) for rows in (slice(None), unsolved))
    return Samples(weight.size, effective, *computed)


def band_words(results: xr.Dataset) -> str:
    """`10 to 90 % quantiles`."""
    return f"{100.0 * QUANTILES[0]:.0f} to {100.0 * QUANTILES[-1]:.0f} % quantiles"
