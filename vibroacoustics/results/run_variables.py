"""Variables and coordinates that a report and a score read from a run, and what they must hold."""

import tomllib
from importlib import resources
from itertools import chain
from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import SchemaError
from ..base.vocabulary import (
    AXES,
    COORDINATES,
    REFERENCE_OPTION,
    RIGID_BODY_DOFS,
    SUFFIXES,
    VARIABLES,
    WEIGHTINGS,
    check,
)

_RULES: Final = tomllib.loads(
    resources.files(__package__).joinpath("run_variables.toml").read_text("utf-8")
)
"""Which variables a run has, and with what; the file explains each table."""
COORDINATES_OF: Final[dict[str, list[str]]] = _RULES["coordinates_of"]
EMPTY_WHERE_NONE: Final = frozenset(_RULES["empty_where_none"])
ADDED_MASS: Final = "added_mass_kg"
"""Figure that every option has."""
ANY_WEIGHTS: Final = "any"
"""Ranks with weights of the criteria sampled evenly from all that there are."""
OF_THE_STUDY: Final = "of the study"
"""Ranks with the weights that the study gives."""
LABELS: Final[dict[str, tuple[str, ...]]] = {
    "option": (REFERENCE_OPTION,),
    "axis": AXES,
    "dof": RIGID_BODY_DOFS,
    "weighting": WEIGHTINGS,
    "criteria_weights": (ANY_WEIGHTS, OF_THE_STUDY),
    "figure": (ADDED_MASS,),
    "stopping_phase": ("steady", "stopping"),
}
"""What a dimension must hold; others are free."""
AMONG: Final = {"path_speed": "speed", "path_order": "order"}
"""Dimensions whose values are some of those of another."""
IN_ORDER: Final = ("axis", "dof")
"""Dimensions that hold nothing else, in this order."""
LARGEST: Final = 1e30
"""Of any value, whose squares are summed."""
LARGEST_LEVEL_DB: Final = 1e3
"""Whose power is summed."""
HIGHEST_COLUMN: Final = 2
"""Highest order that has a column in the comparison."""


def check_variables(results: xr.Dataset) -> None:
    """Refuse what lacks a variable or coordinate that a report reads, or holds it otherwise.

    Raises
    ------
    SchemaError
        Names the variable or the coordinate.
    """
    strangers = [name for name in results.data_vars if name not in VARIABLES]
    strangers += [name for name in results.coords if name not in COORDINATES]
    known = results.drop_vars(strangers)
    check(known, needed_variables(known))
    for coordinate in known.coords.values():
        _check_coordinate(coordinate)
    for variable in known.data_vars.values():
        _check_dimensions(known, variable)
        check_numbers(variable)
    _check_labels(known)


def needed_variables(results: xr.Dataset) -> tuple[str, ...]:
    """Variables that must be there, by those that are."""
    several = _RULES["of_several_sources"] if results.sizes.get("sound_source", 0) > 1 else ()
    groups = [group for group in _RULES["together"] if any(name in results for name in group)]
    beside = [names for name, names in _RULES["needs"].items() if name in results]
    return tuple(chain(_RULES["variables_of_a_run"], several, *groups, *beside))


def _check_coordinate(array: xr.DataArray) -> None:
    known = COORDINATES[str(array.name)]
    if array.dims != known.dims:
        raise SchemaError(f"coordinate {array.name}: dims are {array.dims}, must be {known.dims}")
    if array.dtype.kind not in ("iuf" if known.units else "U"):
        raise SchemaError(
            f"coordinate {array.name} holds no {'numbers' if known.units else 'text'}"
        )
    if known.units:
        check_numbers(array)
    if array.dims == (array.name,) and np.unique(array.values).size < array.size:
        raise SchemaError(f"coordinate {array.name} holds a label twice")


def _check_dimensions(results: xr.Dataset, array: xr.DataArray) -> None:
    name = str(array.name)
    for coordinate in (*array.dims, *COORDINATES_OF.get(name, ())):
        if coordinate not in results.coords or not results[coordinate].size:
            raise SchemaError(f"coordinate {coordinate} of {name} is missing or empty")
    for attribute in _RULES["attributes_of"].get(name, ()):
        if not isinstance(array.attrs.get(attribute), str):
            raise SchemaError(f"{name}: attribute {attribute} is missing or no text")


def check_numbers(array: xr.DataArray) -> None:
    """Refuse a variable without finite numbers, but for those that may be empty by design.

    Raises
    ------
    SchemaError
        Names the variable.
    """
    if array.dtype.kind not in "iufc":
        raise SchemaError(f"{array.name} holds no numbers")
    if _without_suffix(str(array.name)) not in EMPTY_WHERE_NONE:
        _check_finite(array)


def _without_suffix(name: str) -> str:
    """Name of the variable that has a statistic under this name."""
    for suffix in SUFFIXES.values():
        name = name.removesuffix(suffix)
    return name


def _check_finite(array: xr.DataArray) -> None:
    largest = LARGEST_LEVEL_DB if array.attrs.get("units") == "dB" else LARGEST
    if not (np.abs(array.values) <= largest).all():  # one that is no number is not less
        raise SchemaError(f"{array.name} holds no number, or one beyond {largest:g}")


def _check_labels(results: xr.Dataset) -> None:
    for dim, needed in LABELS.items():
        if dim in results.coords and not set(needed) <= set(results[dim].values.tolist()):
            raise SchemaError(f"coordinate {dim}: must hold {', '.join(needed)}")
    for dim in IN_ORDER:
        if tuple(results[dim].values) != LABELS[dim]:
            raise SchemaError(f"coordinate {dim}: must be {', '.join(LABELS[dim])}")
    for dim, all_of_it in AMONG.items():
        if dim in results.coords and not np.isin(results[dim], results[all_of_it]).all():
            raise SchemaError(f"coordinate {dim}: must be among those of {all_of_it}")
    order = results["order"].values
    if order.size <= HIGHEST_COLUMN or (order != np.arange(order.size)).any():
        raise SchemaError(
            f"coordinate order: must be 0, 1, 2 and so on, to {HIGHEST_COLUMN} at least"
        )
    if not results["mode_shape"].any(("body", "dof")).all():
        raise SchemaError("mode_shape: in a mode nothing moves")
    _check_finite(results["reported_figure"].sel(figure=ADDED_MASS).rename(ADDED_MASS))
    if "sample_weight" in results and not (results["sample_weight"].values[0] > 0.0).any():
        raise SchemaError("sample_weight: no sample counts")
