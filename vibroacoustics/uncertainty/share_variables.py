"""Unknowns that the modelled level depends on, labelled."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import stamped
from ..levels.agreement import ALL_ALIKE
from ..study.uncertainty import Range
from .bank import Bank
from .shares import Shares, shares_of

BEFORE: Final = "before"
"""Knowledge of the ranges alone."""


def level_shares(ranges: Sequence[Range], bank: Bank, before: Array) -> xr.Dataset:
    """Shares of the sampled values in the modelled level, before and by prior of unmodelled noise.

    Parameters
    ----------
    ranges : of the sampled values
    bank : all samples; where they do not suffice the priors' shares are empty
    before : weights of the samples before the published level, shape (sample,)
    """
    values = np.array([[sample[one.table, one.field] for one in ranges] for sample in bank.samples])
    weighed = list(bank.prior_names) != [ALL_ALIKE.name]  # else after is as before
    after = bank.weight if bank.suffices else 0.0 * bank.weight
    weights = [before, *(after if weighed else ())]
    shares = [shares_of(values, bank.modelled_db, weight) for weight in weights]
    coords = {
        "knowledge": [BEFORE, *(bank.prior_names if weighed else ())],
        "uncertain_parameter": [limits.name for limits in ranges],
    }
    return stamped(labelled_shares("level_share", shares), coords)


def labelled_shares(name: str, shares: Sequence[Shares]) -> dict[str, list[Array | float]]:
    """Shares, ends of their intervals and floors by variable.

    Parameters
    ----------
    name : of the variable of the shares
    shares : of each quantity
    """
    return {
        name: [one.share for one in shares],
        f"{name}_low": [one.low for one in shares],
        f"{name}_high": [one.high for one in shares],
        f"{name}_floor": [one.floor for one in shares],
    }
