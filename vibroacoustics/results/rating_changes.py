"""Tones and rating levels of two studies, and what changes from one to the other."""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from .estimates import Estimate, estimate, has_samples, sample_weights, weighted_estimate
from .figure_limits import Compared

RATED: Final = {
    "decisive_audibility": "receiver",
    "tonal_adjustment": "receiver",
    "rating_level": "rating_window",
    "rating_adjustment": "rating_window",
    "rating_limit": "rating_window",
    "limit_probability": "rating_window",
}
"""Variables that are compared, and the dimension of microphones or windows."""


class RatingChange(NamedTuple):
    """A variable of two studies at a microphone or a window.

    Attributes
    ----------
    variable : one of `RATED`
    label : microphone or window
    speed_rpm : speed of the first result
    first, second : values in the unit of the vocabulary
    change : second less first; with its interval where both have the same samples, else the
        difference of the values
    """

    variable: str
    label: str
    speed_rpm: float
    first: Estimate
    second: Estimate
    change: Estimate


def rating_changes(compared: Compared, speeds_rpm: Sequence[float]) -> list[RatingChange]:
    """Compare tones and rating levels that both studies have; empty of recordings.

    Parameters
    ----------
    compared : two results
    speeds_rpm : some speeds of the first result
    """
    pairs = [compared.orders[name].values.tolist() for name in ("speed", "compared_speed")]
    speeds = [pair for pair in zip(*pairs, strict=True) if pair[0] in speeds_rpm]
    return [
        _change(compared, variable, label, of_speeds)
        for variable, dim in RATED.items()
        for label, of_speeds in product(_labels(compared, variable, dim), speeds)
    ]


def _labels(compared: Compared, variable: str, dim: str) -> Iterator[str]:
    """Microphones or windows of a variable that both results have."""
    if all(variable in result for result in (compared.first, compared.second)):
        names = map(str, compared.first[dim].values)
        yield from (name for name in names if name in compared.second[dim].values)


def _change(
    compared: Compared, variable: str, label: str, speeds_rpm: tuple[float, float]
) -> RatingChange:
    cases: list[tuple[xr.Dataset, dict[str, Any]]] = [
        (result, {RATED[variable]: label, "speed": speed, "option": option})
        for (_, result, option, _), speed in zip(compared.sides(), speeds_rpm, strict=True)
    ]
    first, second = (estimate(result, variable, **case) for result, case in cases)
    difference = second.value - first.value
    change = _in_samples(variable, cases) or Estimate(difference, difference, difference)
    return RatingChange(variable, label, speeds_rpm[0], first, second, change)


def _in_samples(
    variable: str, cases: Sequence[tuple[xr.Dataset, dict[str, Any]]]
) -> Estimate | None:
    """Median and interval of the change; None where the results have other samples."""
    name = f"{variable}_by_sample"
    if not all(name in result and has_samples(result) for result, _ in cases):
        return None
    weight, other_weight = (sample_weights(result) for result, _ in cases)
    if not np.array_equal(weight, other_weight):
        return None
    first, second = (result[name].sel(case).values for result, case in cases)
    return weighted_estimate(second - first, weight)
