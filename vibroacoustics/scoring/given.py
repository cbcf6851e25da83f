"""Values of criteria that a study gives: cost, assembly, risk, space."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.vocabulary import check, stamp
from ..study.scoring import Given


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
