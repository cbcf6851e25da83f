"""Variables and coordinates that a report and a score read from a run, and what they must hold."""

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

VARIABLES_OF_A_RUN: Final = (
    "natural_frequency", "mode_shape", "mount_transmissibility", "force_amplitude",
    "moment_amplitude", "foot_force_amplitude", "reported_figure",
    "transfer_vector", "order_level", "level_modelled", "level_total", "level_remainder",
    "source_level", "change_1x", "change_modelled", "change_total", "criterion_value",
    "criterion_best", "criterion_worst", "weight", "score", "rank", "first_place_share",
)  # fmt: skip
OF_SEVERAL_SOURCES: Final = ("source_share", "source_band_level")
TOGETHER: Final = (
    ("draw_weight", "source_level_by_draw", "level_modelled_by_draw", "level_total_by_draw",
     "level_remainder_by_draw"),
    ("force_1x_by_draw", "moment_1x_by_draw", "foot_force_1x_by_draw"),
    ("bank_weight", "bank_level", "bank_value"),
    ("shell_likelihood", "shell_gain", "shell_frequency_ratio", "shell_loss_ratio", "shell_value",
     "shell_level_before", "shell_weight"),
    ("level_share", "level_share_quality"),
    ("change_share", "change_share_quality", "change_variance"),
    ("stopping_duration", "stopping_revolutions", "stopping_shaft_speed", "stopping_force",
     "stopping_moment", "stopping_fast_level", "stopping_fast_maximum_level",
     "stopping_peak_level", "stopping_foot_force"),
    ("order_sound_power_level", "sound_power_level"),
    ("path_pressure", "path_level", "path_share", "path_band_level", "path_band_share",
     "modelled_band_level", "motion_level", "motion_share"),
    ("noise_band_level", "remainder_band_level"),
    ("structure_borne_input_power", "structure_borne_power", "structure_borne_line_level",
     "structure_borne_line_low", "structure_borne_line_high", "structure_borne_level",
     "structure_borne_level_low", "structure_borne_level_high", "level_both_ways"),
    ("room_level", "room_source_level", "room_band_level", "room_sound_power_level",
     "room_gain_waves", "room_gain_diffuse", "room_gain_difference", "room_place_gain",
     "room_place_gain_above", "room_absorption_area", "room_map_level"),
    ("room_wall_absorption", "room_wall_absorption_requested"),
    ("room_level_low", "room_level_middle", "room_level_high"),
    ("room_pressure_line", "room_noise_band_level"),
    ("room_plate_level", "room_plate_level_low", "room_plate_level_high", "room_level_both_ways"),
    ("published_score", "published_sum", "recomputed_sum"),
)  # fmt: skip
"""Variables that stand in a run all or none."""
NEEDS: Final = {
    "force_1x_by_draw": ("draw_weight",),
    "level_share": ("bank_weight",),
    "change_share": ("draw_weight",),
    "green_difference": ("line_difference", "transfer_vector_closed_form"),
    "block_velocity_order": ("velocity_order",),
    "stopping_order_map": ("stopping_force",),
    "path_share": ("foot_force_order",),
    "room_level_low": ("room_level", "draw_weight"),
    "room_plate_level": ("room_level", "structure_borne_power"),
    "room_pressure_line": ("room_level",),
    "room_plate_line_level": ("room_plate_level", "room_pressure_line"),
}
"""Further variables, and what stands beside each."""
COORDINATES_OF: Final = {
    "criterion_value": ("criterion_label", "criterion_unit"),
    "block_velocity_order": ("order_frequency",),
    "map_level": ("map_x", "map_y", "map_z"),
    "path_share": ("path_source", "path_port", "path_direction"),
    "stopping_order_map": ("stopping_block_time", "stopping_block_speed"),
}
"""Coordinates that stand beside a variable, apart from those of its dimensions."""
ATTRIBUTES_OF: Final = {
    "supply_frequency": ("source",),
    "sound_power_level": ("arrangement",),
}
EMPTY_WHERE_NONE: Final = frozenset(
    ("reported_figure", "given_value", "projection_error", "bank_level", "tone_frequency",
     "line_order", "map_level", "map_transfer_vector", "green_difference", "level_share",
     "level_share_quality", "change_share", "change_share_quality", "change_variance",
     "baseline_share", "baseline_band_level", "baseline_order_level", "baseline_order_share",
     "baseline_order_phase", "shell_gain", "shell_frequency_ratio", "shell_loss_ratio",
     "shell_level_before", "room_map_level")
)  # fmt: skip
"""Not a number where there is nothing: an option without such a figure, a point in the machine or
in furniture, a microphone that k-Wave did not compute, draws that are too few."""
ONLY_DRAWS_THAT_COUNT: Final = frozenset((*TOGETHER[0][1:-1], *TOGETHER[1]))
"""Not a number in a draw without solution, whose weight is 0."""
ADDED_MASS: Final = "added_mass_kg"
"""Figure that every option has."""
LABELS: Final[dict[str, tuple[str, ...]]] = {
    "option": (REFERENCE_OPTION,),
    "axis": AXES,
    "dof": RIGID_BODY_DOFS,
    "weighting": WEIGHTINGS,
    "criteria_weights": ("any", "of the study"),
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
    for name in ONLY_DRAWS_THAT_COUNT & known.keys():
        _check_finite(known[name].isel(draw=known["draw_weight"].values[0] > 0.0))
    _check_labels(known)


def needed_variables(results: xr.Dataset) -> tuple[str, ...]:
    """Variables that must be there, by those that are."""
    several = OF_SEVERAL_SOURCES if results.sizes.get("sound_source", 0) > 1 else ()
    groups = [group for group in TOGETHER if any(name in results for name in group)]
    beside = [names for name, names in NEEDS.items() if name in results]
    return tuple(
        name for names in (VARIABLES_OF_A_RUN, several, *groups, *beside) for name in names
    )


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
    for attribute in ATTRIBUTES_OF.get(name, ()):
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
    if array.name not in EMPTY_WHERE_NONE | ONLY_DRAWS_THAT_COUNT:
        _check_finite(array)


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
    if "draw_weight" in results and not (results["draw_weight"].values[0] > 0.0).any():
        raise SchemaError("draw_weight: no draw counts")
