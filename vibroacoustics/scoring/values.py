"""Value, words and unit of each criterion that is scored, computed or given."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.quantiles import weighted_quantiles
from ..base.units import split_key
from ..results.estimates import has_samples, sample_weights
from ..study.criterion import CRITERIA
from ..study.scoring import CriterionScale, Scoring


class Scored(NamedTuple):
    """One criterion of a scoring.

    Attributes
    ----------
    name, label, unit : key in study files, plain words, symbol
    values : (option,), in that unit; medians of the weighted samples where there are some
    by_sample : (sample, option), in that unit; none where no sample changes it
    """

    name: str
    label: str
    unit: str
    values: Array
    by_sample: Array | None = None


def scored_criteria(results: xr.Dataset, settings: Scoring) -> list[Scored]:
    """Criteria of the settings: first those computed, as registered, then those given, by name.

    Their order does not depend on the file: a seed then means the same weightings from any.

    Raises
    ------
    ParameterError
        A criterion is neither registered nor given, or has no value for an option.
    """
    known = _given_names(results)
    computed = [name for name in CRITERIA if name in settings.criteria and name not in known]
    given = sorted(set(settings.criteria) - set(computed))
    every = []
    for name in computed:
        with CRITERIA.spared(), CRITERIA.fenced(name):
            every.append(_computed(name, results))
    every += [_given(name, settings.criteria[name], results) for name in given]
    if not sum(settings.criteria[one.name].weight for one in every) > 0.0:
        raise ParameterError("scoring.criteria: none with a weight above 0 has values")
    return [one._replace(label=settings.criteria[one.name].title or one.label) for one in every]


def _computed(name: str, results: xr.Dataset) -> Scored:
    criterion = CRITERIA[name]()
    try:
        values = criterion.value(results)
    except KeyError as error:
        raise ParameterError(f"criterion {name}: not in the results: {error}") from None
    if values.dims != ("option",):
        raise ParameterError(f"criterion {name}: has dims {values.dims}, must have ('option',)")
    for option in _options_without(values):
        raise ParameterError(f"criterion {name}: has no finite value for the option {option}")
    scored = _worded(name, criterion.label, criterion.unit, values)
    sampled = criterion.by_sample(results) if has_samples(results) else None
    if sampled is None:
        return scored
    weight = sample_weights(results)
    by_sample = _of_samples(name, sampled)
    (median,) = weighted_quantiles(by_sample, weight, [0.5])
    return scored._replace(values=median, by_sample=by_sample)


def _of_samples(name: str, sampled: xr.DataArray) -> Array:
    """Values in each sample, (sample, option)."""
    if set(sampled.dims) != {"sample", "option"}:
        raise ParameterError(f"criterion {name}: by sample has dims {sampled.dims}")
    values = np.asarray(sampled.transpose("sample", "option").values)
    if not np.isfinite(values).all():
        raise ParameterError(f"criterion {name}: by sample has values that are not finite")
    return values


def _given(name: str, scale: CriterionScale, results: xr.Dataset) -> Scored:
    known = _given_names(results)
    if name not in known:
        raise ParameterError(f"criterion {name}: {CRITERIA.unknown(name, known)}")
    values = results["given_value"].sel(given_criterion=name)
    for option in _options_without(values):
        raise ParameterError(f"options.{option}.given.{name}: is missing in the results")
    return _worded(name, scale.label, scale.unit, values)


def _given_names(results: xr.Dataset) -> list[str]:
    if "given_value" not in results:
        return []
    return [str(name) for name in results["given_criterion"].values]


def _options_without(values: xr.DataArray) -> list[str]:
    return [str(option) for option in values["option"].values[~np.isfinite(values.values)]]


def _worded(name: str, label: str, unit: str, values: xr.DataArray) -> Scored:
    """With words and unit from the name where there are no others."""
    stem, suffix = split_key(name)
    words = label or stem.replace("_", " ").capitalize()
    return Scored(name, words, unit or (suffix.symbol if suffix else ""), values.values)
