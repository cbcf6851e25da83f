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


def level_shares(ranges: Sequence[Range], ensemble: PriorEnsemble, before: Array) -> xr.Dataset:
    """Shares of the sampled values in the modelled level, before and by prior of unmodelled noise.

    Parameters
    ----------
    ranges : ranges of the sampled values
    ensemble : all samples; where they do not suffice the priors' shares are empty
    before : weights of the samples before the published level, shape (sample,)
    """
    values = np.array(
        [[sample[limits.table, limits.field] for limits in ranges] for sample in ensemble.samples]
    )
    is_weighted = list(ensemble.prior_names) != [ALL_ALIKE.name]  # else after is as before
    after = ensemble.weight if ensemble.suffices else 0.0 * ensemble.weight
    weights = [before, *(after if is_weighted else ())]
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
        name: [of_quantity.share for of_quantity in shares],
        f"{name}_low": [of_quantity.low for of_quantity in shares],
        f"{name}_high": [of_quantity.high for of_quantity in shares],
        f"{name}_floor": [of_quantity.floor for of_quantity in shares],
    }
