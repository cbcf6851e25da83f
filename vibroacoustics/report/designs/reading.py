"""Designs as the report shows them, from the dataset of a search."""

import json

import numpy as np
import xarray as xr

from ...base.units import split_key
from .evaluated import Column, Evaluated


def evaluated(found: xr.Dataset) -> Evaluated:
    """Columns of the variables, objectives and constraints.

    Parameters
    ----------
    found : of a search of designs
    """
    return Evaluated(
        variables_of(found, "design_value"),
        objectives_of(found, "wanted_value"),
        found["meets_constraints"].values == 1,
        found["on_front"].values == 1,
        found["best_design"].values.astype(np.intp),
    )


def variables_of(found: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the variables of the designs in a variable of the dataset."""
    choices = json.loads(found.attrs["choices"])
    return tuple(
        Column(
            variable_label(str(key)),
            str(found["design_unit"].values[number]),
            found[name].values[:, number],
            tuple(map(str, choices.get(str(key), ()))),
        )
        for number, key in enumerate(found["design_variable"].values)
    )


def objectives_of(found: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the objectives of the designs in a variable of the dataset."""
    return tuple(
        Column(
            str(found["wanted"].values[number]),
            str(found["wanted_unit"].values[number]),
            found[name].values[:, number],
        )
        for number, role in enumerate(found["wanted_role"].values)
        if role in ("least", "greatest")
    )


def variable_label(key: str) -> str:
    """A dotted key in words: `options.weight.mass_g` is `weight: mass`."""
    *tables, last = key.split(".")
    stem = split_key(last)[0].replace("_", " ")
    return f"{tables[-1].replace('_', ' ')}: {stem}" if len(tables) > 1 else stem
