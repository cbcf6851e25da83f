"""Scores and ranks of the options."""

import json
from collections.abc import Sequence
from itertools import repeat

import numpy as np
import xarray as xr
from pydantic import ValidationError

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import check, stamp
from ..results.estimates import has_samples, sample_weights
from ..results.run_variables import ANY_WEIGHTS, OF_THE_STUDY
from ..results.utility import utilities
from ..study.scoring import Scoring
from .acceptability import any_weights, rank_acceptability
from .ranking import METHODS
from .values import Scored, scored_criteria


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
