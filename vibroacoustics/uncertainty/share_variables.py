"""Unknowns that the modelled level depends on, labelled."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import stamped
from ..levels.agreement import ALL_ALIKE
from ..study.uncertainty import Range
from .prior_ensemble import PriorEnsemble
from .shares import Shares, shares_of

BEFORE: Final = "before"
"""Knowledge of the ranges alone."""


def level_shares(
    ranges: Sequence[Range], ensemble: PriorEnsemble, prior_weight: Array
) -> xr.Dataset:
    """Shares of the sampled values in the modelled level, before and by prior of unmodelled noise.

    Parameters
    ----------
    ranges : ranges of the sampled values
    ensemble : all samples; where they do not suffice the priors' shares are empty
    prior_weight : weights of the samples before the published level, shape (sample,)
    """
    values = np.array(
        [[sample[limits.table, limits.field] for limits in ranges] for sample in ensemble.samples]
    )
    # with all alike the posterior weights are the prior ones
    is_weighted = list(ensemble.prior_names) != [ALL_ALIKE.name]
    posterior_weight = ensemble.weight if ensemble.suffices else 0.0 * ensemble.weight
    weights = [prior_weight, *(posterior_weight if is_weighted else ())]
    shares = [shares_of(values, ensemble.modelled_db, weight) for weight in weights]
    coords = {
        "knowledge": [BEFORE, *(ensemble.prior_names if is_weighted else ())],
        "uncertain_parameter": [limits.name for limits in ranges],
    }
    return stamped(labelled_shares("level_share", shares), coords)


def labelled_shares(name: str, shares: Sequence[Shares]) -> dict[str, list[Array | float]]:
    """Shares, ends of their intervals and floors by variable.

    Parameters
    ----------
    name : name of the variable of the shares
    shares : shares of each quantity
    """
    return {
        name: [quantity.share for quantity in shares],
        f"{name}_low": [quantity.low for quantity in shares],
        f"{name}_high": [quantity.high for quantity in shares],
        f"{name}_floor": [quantity.floor for quantity in shares],
    }
