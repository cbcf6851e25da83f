"""Designs as the report shows them, from the dataset of a search."""

import json

import numpy as np
import xarray as xr

from ...base.units import split_key
from .evaluated import Column, Evaluated


def evaluated(search: xr.Dataset) -> Evaluated:
    """Columns of the variables, objectives and constraints.

    Parameters
    ----------
    search : of a search of designs
    """
    return Evaluated(
        variables_of(search, "design_value"),
        objectives_of(search, "wanted_value"),
        search["meets_constraints"].values == 1,
        search["on_front"].values == 1,
        search["best_design"].values.astype(np.intp),
    )


def variables_of(search: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the variables of the designs in a variable of the dataset."""
    choices = json.loads(search.attrs["choices"])
    return tuple(
        Column(
            variable_label(str(key)),
            str(search["design_unit"].values[number]),
            search[name].values[:, number],
            tuple(map(str, choices.get(str(key), ()))),
        )
        for number, key in enumerate(search["design_variable"].values)
    )


def objectives_of(search: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the objectives of the designs in a variable of the dataset."""
    return tuple(
        Column(
            str(search["wanted"].values[number]),
            str(search["wanted_unit"].values[number]),
            search[name].values[:, number],
        )
        for number, role in enumerate(search["wanted_role"].values)
        if role in ("least", "greatest")
    )


def variable_label(key: str) -> str:
    """A dotted key in words: `options.weight.mass_g` is `weight: mass`."""
    *tables, last = key.split(".")
    stem = split_key(last)[0].replace("_", " ")
    return f"{tables[-1].replace('_', ' ')}: {stem}" if len(tables) > 1 else stem
