"""Scores and ranks of the options."""

import json

import numpy as np
import xarray as xr
from pydantic import ValidationError

from ..base.errors import ParameterError
from ..base.vocabulary import check, stamp
from ..study.scoring import Scoring
from .ranking import METHODS, first_place_share, utilities
from .values import scored_criteria


def score(results: xr.Dataset, settings: Scoring | None = None) -> xr.Dataset:
    """Score and rank the options.

    Parameters
    ----------
    results : dataset of a run
    settings : scale and weight of each criterion, number and seed of the random weightings;
        those that the results were made with if none are given

    Returns
    -------
    dataset with criterion_value, its words, unit and scale, weight (sum 1), score and rank by
    method, and first_place_share

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
    first = first_place_share(utility, settings.random_weightings, settings.seed)
    option = {"option": results["option"].values}
    criterion = {
        "criterion": [criterion.name for criterion in criteria],
        "criterion_label": ("criterion", [criterion.label for criterion in criteria]),
        "criterion_unit": ("criterion", [criterion.unit for criterion in criteria]),
    }
    by_method = {**option, "scoring_method": list(METHODS)}
    return check(
        xr.Dataset(
            {
                "criterion_value": stamp("criterion_value", values, {**option, **criterion}),
                "criterion_best": stamp("criterion_best", best, criterion),
                "criterion_worst": stamp("criterion_worst", worst, criterion),
                "weight": stamp("weight", shares, criterion),
                "score": stamp("score", scores, by_method),
                "rank": stamp("rank", ranks.astype(float), by_method),
                "first_place_share": stamp("first_place_share", first, option),
            }
        )
    )


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
