"""Results of a run with other scores."""

import json

import xarray as xr

from ..base.fault import collected
from ..base.plain_bytes import canonical_json, sha256
from ..results.left_out import keep_lines, lines_of
from ..study.criterion import CRITERIA
from ..study.scoring import Scoring
from .scores import score


def scored_again(results: xr.Dataset, settings: Scoring | None) -> xr.Dataset:
    """Results with new scores, and the settings of these among their parameters.

    Parameters
    ----------
    results : dataset of a run
    settings : settings, see `score`
    """
    with collected() as lines:
        scores = score(results, settings)
    kept = results.drop_vars([name for name in scores.variables if name not in scores.indexes])
    kept = kept.drop_dims([dim for dim in scores.dims if dim in kept.dims and dim != "option"])
    again = kept.merge(scores)
    if settings is not None:
        parameters = json.loads(results.attrs["parameters"])
        parameters["scoring"] = settings.model_dump(mode="json")
        text = canonical_json(parameters)
        again.attrs |= {"parameters": text, "parameters_sha256": sha256(text.encode())}
    older = [line for line in lines_of(results) if not line.startswith(f"{CRITERIA.noun} ")]
    return keep_lines(again, [*older, *lines])
