"""Designs as the report shows them, from the dataset of a search."""

import json

import numpy as np
import xarray as xr

from .evaluated import Column, Evaluated


def evaluated(found: xr.Dataset) -> Evaluated:
    """Columns of the variables, objectives and constraints.

    Parameters
    ----------
    found : of a search of designs
    """
    choices = json.loads(found.attrs["choices"])
    variables = tuple(
        Column(
            variable_label(str(key)),
            str(found["design_unit"].values[number]),
            found["design_value"].values[:, number],
            tuple(map(str, choices.get(str(key), ()))),
        )
        for number, key in enumerate(found["design_variable"].values)
    )
    roles = [str(role) for role in found["wanted_role"].values]
    columns = [_wanted(found, number) for number in range(len(roles))]
    aims = tuple(c for c, role in zip(columns, roles, strict=True) if role in _AIMS)
    limits = tuple(c for c, role in zip(columns, roles, strict=True) if role not in _AIMS)
    return Evaluated(
        variables,
        aims,
        limits,
        found["meets_constraints"].values == 1,
        found["on_front"].values == 1,
        found["best_design"].values.astype(np.intp),
    )


_AIMS = ("least", "greatest")


def variable_label(key: str) -> str:
    """A dotted key in words: `options.weight.mass_g` is `weight: mass`."""
    from ...base.units import split_key

    first, *tables, last = key.split(".")
    stem = split_key(last)[0].replace("_", " ")
    inner = " ".join(tables).replace("_", " ")
    return f"{inner}: {stem}" if inner else (stem if tables or "." in key else first)


def _wanted(found: xr.Dataset, number: int) -> Column:
    return Column(
        str(found["wanted_label"].values[number]),
        str(found["wanted_unit"].values[number]),
        found["wanted_value"].values[:, number],
        more_is_better=str(found["wanted_role"].values[number]) in ("greatest", "at least"),
    )
