"""Value, words and unit of each criterion that is scored, computed or given."""

from typing import NamedTuple

import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..results.criterion_values import criterion_values, options_without
from ..study.criterion import CRITERIA, label_and_unit
from ..study.scoring import CriterionScale, Scoring


class Scored(NamedTuple):
    """One criterion of a scoring.

    Attributes
    ----------
    name, label, unit : key in study files, plain words, symbol
    values : values of the options, shape (option,), in that unit; medians of the weighted samples
        where there are some
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
    given_names = _given_names(results)
    computed = [name for name in CRITERIA if name in settings.criteria and name not in given_names]
    not_computed = sorted(set(settings.criteria) - set(computed))
    every = []
    for name in computed:
        with CRITERIA.spared(), CRITERIA.fenced(name):
            every.append(_computed(name, results))
    every += [_given(name, settings.criteria[name], results) for name in not_computed]
    if not sum(settings.criteria[value.name].weight for value in every) > 0.0:
        raise ParameterError("scoring.criteria: none with a weight above 0 has values")
    return [
        value._replace(label=settings.criteria[value.name].title or value.label) for value in every
    ]


def _computed(name: str, results: xr.Dataset) -> Scored:
    criterion, computed = CRITERIA[name], criterion_values(results, name)
    return Scored(name, *label_and_unit(name, criterion.label, criterion.unit), *computed)


def _given(name: str, scale: CriterionScale, results: xr.Dataset) -> Scored:
    given_names = _given_names(results)
    if name not in given_names:
        raise ParameterError(f"criterion {name}: {CRITERIA.unknown(name, given_names)}")
    values = results["given_value"].sel(given_criterion=name)
    for option in options_without(values):
        raise ParameterError(f"options.{option}.given.{name}: is missing in the results")
    return Scored(name, *label_and_unit(name, scale.label, scale.unit), values.values)


def _given_names(results: xr.Dataset) -> list[str]:
    if "given_value" not in results:
        return []
    return [str(name) for name in results["given_criterion"].values]
