"""Values of a criterion that the results of a run give."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.quantiles import weighted_quantiles
from ..study.criterion import CRITERIA
from .estimates import has_samples, sample_weights


class CriterionValues(NamedTuple):
    """Values of a criterion, in its unit.

    Attributes
    ----------
    values : medians of the weighted samples where there are some, shape (option,)
    by_sample : shape (sample, option); none where no sample changes the values
    """

    values: Array
    by_sample: Array | None = None


def criterion_values(results: xr.Dataset, name: str) -> CriterionValues:
    """Compute a registered criterion of every option.

    Parameters
    ----------
    results : results of a run
    name : name of the criterion

    Raises
    ------
    ParameterError
        The results lack what it needs, or it has no finite value for an option.
    """
    criterion = CRITERIA[name]()
    try:
        values = criterion.value(results)
    except KeyError as error:
        raise ParameterError(f"criterion {name}: not in the results: {error}") from None
    if values.dims != ("option",):
        raise ParameterError(f"criterion {name}: has dims {values.dims}, must have ('option',)")
    for option in options_without(values):
        raise ParameterError(f"criterion {name}: has no finite value for the option {option}")
    sampled = criterion.by_sample(results) if has_samples(results) else None
    if sampled is None:
        return CriterionValues(values.values)
    by_sample = _of_samples(name, sampled)
    (median,) = weighted_quantiles(by_sample, sample_weights(results), [0.5])
    return CriterionValues(median, by_sample)


def options_without(values: xr.DataArray) -> list[str]:
    """Return the options without a finite value."""
    return [str(option) for option in values["option"].values[~np.isfinite(values.values)]]


def _of_samples(name: str, sampled: xr.DataArray) -> Array:
    """Values in each sample, (sample, option)."""
    if set(sampled.dims) != {"sample", "option"}:
        raise ParameterError(f"criterion {name}: by sample has dims {sampled.dims}")
    values = np.asarray(sampled.transpose("sample", "option").values)
    if not np.isfinite(values).all():
        raise ParameterError(f"criterion {name}: by sample has values that are not finite")
    return values
