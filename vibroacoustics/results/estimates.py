"""Estimates of a run: the value of a quantity with its 80 % interval, or its nominal value."""

from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.quantiles import weighted_quantiles
from ..base.remembered import remembered
from ..base.vocabulary import HIGH, LOW, NOMINAL, SUFFIXES, VARIABLES

QUANTILES: Final = (0.1, 0.9)
"""Probabilities of a smaller value at the ends of intervals."""


ENSEMBLE_WEIGHT: Final = "prior_sample_weight"
"""Variable that the digits of values follow from."""


class Estimate(NamedTuple):
    """A value with the ends of its 80 % interval.

    Attributes
    ----------
    low : lower end; the value where it is nominal
    value : median or mean of the samples, as the vocabulary says, or the nominal value
    high : upper end; the value where it is nominal

    Examples
    --------
    >>> level = va.Estimate(54.0, 56.4, 59.0)
    >>> f"{level.value} dB(A), 80 %: {level.low} to {level.high}"
    '56.4 dB(A), 80 %: 54.0 to 59.0'
    """

    low: float
    value: float
    high: float


def estimate(results: xr.Dataset, variable: str, **selection: Any) -> Estimate:
    """Return the value of a variable with its interval.

    Parameters
    ----------
    results : results of a run
    variable : name in the vocabulary
    selection : a label of each of its dimensions; those of others are not used

    Raises
    ------
    ParameterError
        The results hold no such variable or label.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> at = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}
    >>> round(va.estimate(results, "level_total", **at).value, 1)
    56.2
    """
    if variable not in results:
        raise ParameterError(f"variable = {variable!r}: is not in the results")
    names = [part if part in results else variable for part in _names(variable)]
    values = [_value(results, name, selection) for name in names]
    return Estimate(*values)


def is_sampled(results: xr.Dataset, variable: str) -> bool:
    """Return whether a variable was computed in samples."""
    return f"{variable}{SUFFIXES[LOW]}" in results


def nominal(results: xr.Dataset, variable: str) -> xr.DataArray:
    """Return the nominal values of a variable."""
    name = f"{variable}{SUFFIXES[NOMINAL]}"
    return results[name if name in results else variable].rename(variable)


def nominal_values(results: xr.Dataset) -> xr.Dataset:
    """Return results with the nominal values in place of statistics of samples."""
    suffix = SUFFIXES[NOMINAL]
    names = [str(name) for name in results.data_vars if str(name).endswith(suffix)]
    replaced = {
        name.removesuffix(suffix): nominal(results, name.removesuffix(suffix)) for name in names
    }
    return results.drop_vars(names).assign(replaced)


def interval(results: xr.Dataset, variable: str) -> xr.Dataset:
    """Return `low`, `value` and `high` of a variable; equal where it is nominal."""
    names = [part if part in results else variable for part in _names(variable)]
    parts = zip(Estimate._fields, names, strict=True)
    return xr.Dataset({part: results[name].drop_attrs() for part, name in parts})


def has_samples(results: xr.Dataset) -> bool:
    """Return whether a run has weighted samples."""
    return "sample_weight" in results


class InSamples(NamedTuple):
    """A quantity in every weighted sample.

    Attributes
    ----------
    values : labelled, with the dimension `sample`
    weight : weights of sum one, shape (sample,)
    """

    values: xr.DataArray
    weight: Array


def in_samples(results: xr.Dataset, variable: str) -> InSamples:
    """Return a variable that is kept by sample, the dimension `sample` first."""
    values = results[f"{variable}_by_sample"].transpose("sample", ...)
    return InSamples(values, sample_weights(results))


def sample_weights(results: xr.Dataset) -> Array:
    """Return the weights of the samples with the first prior, of sum one, shape (sample,)."""
    return np.asarray(results["sample_weight"].values[0])


def weighted_estimate(values: Array, weight: Array) -> Estimate:
    """Return median and interval of weighted values, both of shape (sample,)."""
    low, middle, high = weighted_quantiles(values, weight, (QUANTILES[0], 0.5, QUANTILES[1]))
    return Estimate(float(low), float(middle), float(high))


class Ensemble(NamedTuple):
    """Samples of the prior ensemble.

    Attributes
    ----------
    level_dba : modelled levels where one is published, not a number without a solution, shape
        (sample,)
    weight : by prior of the unmodelled noise, shape (prior, sample)
    before : weight before the published data, shape (sample,)
    value : values of the uncertain parameters, (sample, parameter)
    """

    level_dba: Array
    weight: Array
    before: Array
    value: xr.DataArray


def prior_ensemble(results: xr.Dataset) -> Ensemble | None:
    """Return the prior ensemble of a run; None where nothing was sampled."""
    if "prior_sample_weight" not in results:
        return None
    levels = results["prior_sample_level"].values
    before = results["shell_weight"].values if "shell_weight" in results else np.ones(levels.size)
    value = results["prior_sample_value"].transpose("prior_sample", ...)
    return Ensemble(levels, results["prior_sample_weight"].values, before, value)


def effective_number(weight: Array) -> float:
    """Return the number of equal samples that weighted ones are worth (Kish 1965)."""
    return float(weight.sum() ** 2 / (weight**2).sum()) if weight.any() else 0.0


@remembered
def effective_samples(results: xr.Dataset) -> float:
    """Return the effective number of samples at the published level."""
    return effective_number(results["prior_sample_weight"].values[0])


class SampleNumbers(NamedTuple):
    """Numbers of samples.

    Attributes
    ----------
    tried : at the point of the published level
    effective : effective number of samples, weighted by the likelihood
    computed : in all cases
    """

    tried: int
    effective: float
    computed: int


def sample_numbers(results: xr.Dataset) -> SampleNumbers:
    """Return the numbers of samples that the intervals depend on."""
    tried, computed = results.sizes["prior_sample"], 0
    if has_samples(results):
        values = results["sampled_value"].transpose("sample", ...).values
        computed = len(np.unique(values, axis=0))
    return SampleNumbers(tried, effective_samples(results), computed)


def estimated(results: xr.Dataset, statistics: xr.Dataset) -> xr.Dataset:
    """Return results with statistics of samples in place of nominal values, which stay beside."""
    if not statistics.variables:
        return results
    kept = {
        f"{name}{SUFFIXES[NOMINAL]}": _nominal(results, name)
        for name in map(str, statistics.data_vars)
        if name in results and VARIABLES[name].of_samples()
    }
    others = results.drop_vars([name for name in statistics.data_vars if name in results])
    # Lines and their frequencies are those of the sample that they belong to.
    merged = xr.merge([statistics, others], compat="override", join="left")
    return merged.assign(kept).assign_attrs(results.attrs)


def _nominal(results: xr.Dataset, name: str) -> xr.DataArray:
    """Nominal values under their own name."""
    variable = VARIABLES[f"{name}{SUFFIXES[NOMINAL]}"]
    values = results[name].rename(variable.name).reset_coords(drop=True)
    return values.assign_attrs(long_name=variable.long_name)


def _names(variable: str) -> tuple[str, str, str]:
    return f"{variable}{SUFFIXES[LOW]}", variable, f"{variable}{SUFFIXES[HIGH]}"


def _value(results: xr.Dataset, name: str, selection: dict[str, Any]) -> float:
    values, positions = _table(results, name)
    for dim, position in positions.items():
        if selection.get(dim) not in position:
            labels = ", ".join(map(str, position))
            raise ParameterError(f"{name}: {dim} = {selection.get(dim)!r}: must be one of {labels}")
    cell = tuple(position[selection[dim]] for dim, position in positions.items())
    return float(values[cell])


@remembered
def _table(results: xr.Dataset, name: str) -> tuple[Any, dict[str, dict[Any, int]]]:
    """Values of a variable, and the position of each label by dimension."""
    array = results[name]
    positions = {
        str(dim): {key: n for n, key in enumerate(array[dim].values.tolist())} for dim in array.dims
    }
    return array.values, positions
