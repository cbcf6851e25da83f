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
    VARIABLES,
    WEIGHTINGS,
    check,
)

_RULES: Final = tomllib.loads(
    resources.files(__package__).joinpath("run_variables.toml").read_text("utf-8")
)
"""Conditions on the variables of a run; the file explains each table."""
COORDINATES_OF: Final[dict[str, list[str]]] = _RULES["coordinates_of"]
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
"""Labels that a dimension must hold; others are free."""
AMONG: Final = {"path_speed": "speed", "path_order": "order"}
"""Dimensions whose values are some of those of another."""
BESIDE: Final = {"speed": "branch"}
"""Dimensions whose labels may repeat where another coordinate differs."""
IN_ORDER: Final = ("axis", "dof")
"""Dimensions that hold nothing else, in this order."""
HIGHEST_COLUMN: Final = 2
"""Highest order that has a column in the comparison."""


def check_variables(results: xr.Dataset) -> None:
    """Refuse what lacks a variable or coordinate that a report reads, or holds it otherwise."""
    declared_results = check_known(results)
    check(declared_results, needed_variables(declared_results))
    for name in declared_results.data_vars:
        _check_dimensions(declared_results, str(name))
    _check_labels(declared_results)


def check_known(results: xr.Dataset) -> xr.Dataset:
    """Return the part of any results that the vocabulary knows; its values can be right."""
    third_party = [name for name in results.data_vars if name not in VARIABLES]
    third_party += [name for name in results.coords if name not in COORDINATES]
    checked = check(results.drop_vars(third_party))
    for name in checked.coords:
        _check_coordinate(str(name), checked.variables[name])
    for name in checked.dims:
        _check_labels_of(checked, str(name))
    for name in checked.data_vars:
        VARIABLES[str(name)].check_numbers(checked.variables[name])
    return checked


def needed_variables(results: xr.Dataset) -> tuple[str, ...]:
    """Variables that must be there, by those that are."""
    several = _RULES["of_several_sources"] if results.sizes.get("sound_source", 0) > 1 else ()
    groups = [group for group in _RULES["together"] if any(name in results for name in group)]
    beside = [names for name, names in _RULES["needs"].items() if name in results]
    return tuple(chain(_RULES["variables_of_a_run"], several, *groups, *beside))


def _check_coordinate(name: str, array: xr.Variable) -> None:
    declared = COORDINATES[name]
    if array.dims != declared.dims:
        raise SchemaError(f"coordinate {name}: dims are {array.dims}, must be {declared.dims}")
    if declared.is_text and array.dtype.kind != "U":
        raise SchemaError(f"coordinate {name} holds no text")
    if not declared.is_text:
        declared.check_numbers(array)


def _check_labels_of(results: xr.Dataset, name: str) -> None:
    """Refuse a label that is there twice; a speed may be, in another branch."""
    labels = [
        results.variables[each].values.tolist()
        for each in (name, BESIDE.get(name, name))
        if each in results.coords
    ]
    pairs = [*zip(*labels, strict=True)]
    if len(set(pairs)) < len(pairs):
        raise SchemaError(f"coordinate {name} holds a label twice")


def _check_dimensions(results: xr.Dataset, name: str) -> None:
    array = results.variables[name]
    for coordinate in (*array.dims, *COORDINATES_OF.get(name, ())):
        if coordinate not in results.coords or not results.variables[coordinate].size:
            raise SchemaError(f"coordinate {coordinate} of {name} is missing or empty")
    for attribute in _RULES["attributes_of"].get(name, ()):
        if not isinstance(array.attrs.get(attribute), str):
            raise SchemaError(f"{name}: attribute {attribute} is missing or no text")


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
    if not np.isfinite(results["reported_figure"].sel(figure=ADDED_MASS)).all():
        raise SchemaError(f"{ADDED_MASS}: holds no number")
    if "sample_weight" in results and not (results["sample_weight"].values[0] > 0.0).any():
        raise SchemaError("sample_weight: no sample counts")
