"""Criteria of the options: values, scores and ranks, beside published scores."""

import json
from collections.abc import Callable, Sequence
from itertools import repeat
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from pydantic import ValidationError

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import check, stamp
from ..results.criterion_values import criterion_values, options_without
from ..results.estimates import has_samples, sample_weights
from ..results.run_variables import ANY_WEIGHTS, OF_THE_STUDY
from ..results.utility import utilities
from ..study.criterion import CRITERIA, label_and_unit
from ..study.scoring import CriterionScale, Given, PublishedTable, Scoring
from .acceptability import any_weights, rank_acceptability


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


def weighted_sum(utility: Array, shares: Array) -> Array:
    """Sum of the utilities times their weights."""
    return utility @ shares


def topsis(utility: Array, shares: Array) -> Array:
    """Closeness to the ideal option (Hwang & Yoon 1981): d⁻ / (d⁺ + d⁻)."""
    to_ideal = np.linalg.norm((1.0 - utility) * shares, axis=1)
    to_worst = np.linalg.norm(utility * shares, axis=1)
    total = to_ideal + to_worst
    return np.where(total > 0.0, to_worst / np.where(total > 0.0, total, 1.0), 1.0)


METHODS: Final[dict[str, Callable[[Array, Array], Array]]] = {
    "weighted_sum": weighted_sum,
    "topsis": topsis,
}


def published_table(table: PublishedTable) -> xr.Dataset:
    """A published table of scores as printed, with its sums added up again."""
    options = {"published_option": list(table.options)}
    scores = np.array(table.scores, dtype=float)
    return check(
        xr.Dataset(
            {
                "published_score": stamp(
                    "published_score",
                    scores,
                    {**options, "published_criterion": list(table.criteria)},
                    source=table.source,
                ),
                "published_sum": stamp("published_sum", table.sums, options, source=table.source),
                "recomputed_sum": stamp("recomputed_sum", scores.sum(axis=1), options),
            }
        )
    )


def given_values(values_of_option: Given, options: Sequence[str]) -> xr.Dataset:
    """Dataset with given_value, not a number where an option gives none; empty if none does."""
    names = sorted({name for values in values_of_option.values() for name in values})
    if not names:
        return xr.Dataset()
    values = [
        [values_of_option.get(option, {}).get(name, np.nan) for name in names] for option in options
    ]
    coords = {"option": list(options), "given_criterion": names}
    return check(xr.Dataset({"given_value": stamp("given_value", values, coords)}))


def score(results: xr.Dataset, settings: Scoring | None = None) -> xr.Dataset:
    """Score and rank the options.

    Parameters
    ----------
    results : dataset of a run
    settings : scale and weight of each criterion, number (a sample) and seed of the random
        weightings; those that the results were made with if none are given

    Returns
    -------
    dataset with criterion_value, its words, unit and scale, weight (sum 1), score and rank by
    method, rank_acceptability and its first position, first_place_share

    Raises
    ------
    ParameterError
        A criterion is unknown or has no value for an option.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.score(results)["rank"].dims
    ('option', 'scoring_method')
    """
    settings = settings or _stored_settings(results)
    criteria = scored_criteria(results, settings)
    scales = [settings.criteria[criterion.name] for criterion in criteria]
    best = np.array([scale.best for scale in scales])
    worst = np.array([scale.worst for scale in scales])
    shares = np.array([scale.weight for scale in scales])
    shares /= shares.sum()
    values = np.stack([criterion.values for criterion in criteria], axis=1)
    utility = utilities(values, best, worst)
    scores = np.stack([method(utility, shares) for method in METHODS.values()], axis=1)
    # Rounded, so that options that differ by rounding errors share their rank.
    ranks = 1 + (scores.round(9) > scores.round(9)[:, None]).sum(axis=1)
    positions = _positions(results, criteria, utility, shares, settings)
    option = {"option": results["option"].values}
    criterion = {
        "criterion": [criterion.name for criterion in criteria],
        "criterion_label": ("criterion", [criterion.label for criterion in criteria]),
        "criterion_unit": ("criterion", [criterion.unit for criterion in criteria]),
    }
    by_method = {**option, "scoring_method": list(METHODS)}
    by_position = {
        "criteria_weights": [ANY_WEIGHTS, OF_THE_STUDY],
        **option,
        "rank_position": np.arange(1.0, 1.0 + len(utility)),
    }
    return check(
        xr.Dataset(
            {
                "criterion_value": stamp("criterion_value", values, {**option, **criterion}),
                "criterion_best": stamp("criterion_best", best, criterion),
                "criterion_worst": stamp("criterion_worst", worst, criterion),
                "weight": stamp("weight", shares, criterion),
                "score": stamp("score", scores, by_method),
                "rank": stamp("rank", ranks.astype(float), by_method),
                "first_place_share": stamp("first_place_share", positions[0, :, 0], option),
                "rank_acceptability": stamp("rank_acceptability", positions, by_position),
            }
        )
    )


def _positions(
    results: xr.Dataset,
    criteria: Sequence[Scored],
    utility: Array,
    shares: Array,
    settings: Scoring,
) -> Array:
    """Probability of each rank by any weights and those of the study, (2, option, position)."""
    weight = sample_weights(results) if has_samples(results) else np.ones(1)
    of_samples = np.repeat(utility[None], weight.size, axis=0)
    for number, criterion in enumerate(criteria):
        if criterion.by_sample is not None:
            scale = settings.criteria[criterion.name]
            ends = np.array(scale.best), np.array(scale.worst)
            of_samples[..., number] = utilities(criterion.by_sample, *ends)
    sampled = any_weights(len(criteria), settings.random_weightings, settings.seed)
    as_given = repeat(shares[None])
    return np.stack([rank_acceptability(of_samples, weight, some) for some in (sampled, as_given)])


def _stored_settings(results: xr.Dataset) -> Scoring:
    try:
        stored = json.loads(results.attrs["parameters"])["scoring"]
        return Scoring.model_validate_json(json.dumps(stored))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, ("scoring", *first["loc"])))
        raise ParameterError(f"results hold no scoring settings: {where}: {first['msg']}") from None
    except (KeyError, ValueError) as error:
        raise ParameterError(f"results hold no scoring settings: {error}") from None
