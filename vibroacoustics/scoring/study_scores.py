"""Scores of a study's options."""

import xarray as xr

from ..study.study import Study
from .scores import given_values, published_table, score


def study_scores(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Values and scores of the criteria, and the published table where the study has one."""
    given_scores = given_values(study.given, list(study.options))
    scores = score(results.merge(given_scores), study.scoring).merge(given_scores)
    if study.scoring.published is None:
        return scores
    return scores.merge(published_table(study.scoring.published))
