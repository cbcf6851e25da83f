"""The vocabulary: dimensions, unit and long name of every variable that leaves a stage."""

from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from .errors import SchemaError


class Variable(NamedTuple):
    dims: tuple[str, ...]
    units: str
    long_name: str
    complex_peak: bool = False


AXES: Final = ("x", "y", "z")
RIGID_BODY_DOFS: Final = ("tx", "ty", "tz", "rx", "ry", "rz")
"""Translations (m/s) and rotations (rad/s) along and about x, y, z at the centre of mass."""
WEIGHTINGS: Final = ("Z", "A", "C")
REFERENCE_OPTION: Final = "none"
"""The option against which every change is told."""
NO_ANGLE_ZERO: Final = "none"
"""Attribute `angle_zero` of orders whose phases count from no mark on the shaft."""
DOF_UNIT_NOTE: Final = "unit of the translations; for rotations with rad in place of m"

COORDINATES: Final[dict[str, Variable]] = {
    "speed": Variable(("speed",), "rpm", "shaft speed"),
    "option": Variable(("option",), "", "balancing option"),
    "source": Variable(("source",), "", "moving part that makes the force"),
    "axis": Variable(("axis",), "", "axis of the machine"),
    "crank_angle": Variable(("crank_angle",), "rad", "crank angle"),
    "order": Variable(("order",), "1", "shaft order"),
    "dof": Variable(("dof",), "", "degree of freedom of the housing at its centre of mass"),
    "foot": Variable(("foot",), "", "mounting foot"),
    "mode": Variable(("mode",), "", "rigid-body mode on the mounts"),
    "body": Variable(("body",), "", "rigid body of the machine"),
    "receiver": Variable(("receiver",), "", "microphone"),
    "frequency": Variable(("frequency",), "Hz", "frequency"),
    "line_frequency": Variable(("line_frequency",), "Hz", "frequency of the 1x line"),
    "position": Variable(("position",), "1", "microphone position on the measurement surface"),
    "map_row": Variable(("map_row",), "1", "row of the map"),
    "map_column": Variable(("map_column",), "1", "column of the map"),
    "polar_angle": Variable(("polar_angle",), "rad", "angle from the upward vertical"),
    "azimuth": Variable(("azimuth",), "rad", "angle about the vertical, from x towards y"),
    "pattern": Variable(("pattern",), "", "surface velocity given by a file"),
    "mount_frequency": Variable(("mount_frequency",), "Hz", "frequency of the mounts' response"),
    "weighting": Variable(("weighting",), "", "frequency weighting (IEC 61672-1)"),
    "figure": Variable(("figure",), "", "reported figure, unit in its name"),
    "criterion": Variable(("criterion",), "", "scoring criterion"),
    "criterion_label": Variable(("criterion",), "", "the criterion in plain words"),
    "criterion_unit": Variable(("criterion",), "", "unit of the criterion"),
    "given_criterion": Variable(("given_criterion",), "", "criterion whose values are given"),
    "scoring_method": Variable(("scoring_method",), "", "scoring method"),
    "published_option": Variable(("published_option",), "", "option in the published table"),
    "published_criterion": Variable(("published_criterion",), "", "criterion in the table"),
    "order_frequency": Variable(("speed", "order"), "Hz", "frequency of a shaft order"),
    "crank_time": Variable(("speed", "option", "crank_angle"), "s", "time from crank angle zero"),
    "distance": Variable(("receiver",), "m", "distance of the microphone from the centre of mass"),
    "position_distance": Variable(("position",), "m", "distance from the centre of mass"),
    "map_x": Variable(("map_row", "map_column"), "m", "x from the centre of mass"),
    "map_y": Variable(("map_row", "map_column"), "m", "y from the centre of mass"),
    "map_z": Variable(("map_row", "map_column"), "m", "z from the centre of mass"),
    "channel": Variable(("channel",), "", "channel of a recording"),
    "channel_unit": Variable(("channel",), "", "unit of the channel's samples"),
    "calibration_factor": Variable(
        ("channel",), "", "channel's unit per unit stored in the file, already applied"
    ),
    "time": Variable(("time",), "s", "time from the start of the recording"),
    "block": Variable(("block",), "1", "block of revolutions of a recording"),
    "block_time": Variable(("block",), "s", "middle of the block"),
    "block_speed": Variable(("block",), "rpm", "mean speed over the block"),
    "block_count": Variable(("speed",), "1", "blocks at the speed"),
    "map_order": Variable(("map_order",), "1", "shaft order"),
    "average_angle": Variable(("average_angle",), "rad", "crank angle over a revolution"),
    "band": Variable(("band",), "Hz", "nominal midband frequency of a third of an octave"),
    "fault": Variable(("fault",), "", "missing or double pulse of the tacho"),
    "compared_channel": Variable(("channel",), "", "channel of the other result"),
    "compared_speed": Variable(("speed",), "rpm", "speed in the other result"),
    "sound_source": Variable(("sound_source",), "", "what makes the sound"),
    "line": Variable(("line",), "", "order or other tone"),
    "tone_frequency": Variable(("speed", "line"), "Hz", "frequency of a line; empty without it"),
    "line_order": Variable(("line",), "1", "shaft order of a line; empty where it is none"),
    "draw": Variable(("draw",), "1", "random set of values"),
    "drawn_parameter": Variable(("drawn_parameter",), "", "value that is drawn, SI unit in name"),
    "stopping_time": Variable(("stopping_time",), "s", "time from switch-off"),
    "stopping_phase": Variable(("stopping_phase",), "", "before or after switch-off"),
    "stopping_block": Variable(("stopping_block",), "1", "block of revolutions of the run-down"),
    "stopping_block_time": Variable(("stopping_block",), "s", "middle of the block"),
    "stopping_block_speed": Variable(("stopping_block",), "rpm", "mean speed over the block"),
    "column": Variable(("column",), "", "further column of the comparison, unit in its name"),
    "foot_position": Variable(
        ("foot", "axis"), "m", "foot position from the centre of mass at rest"
    ),
}

_FORCES = ("speed", "option", "source", "axis")
_ORDERS = ("speed", "option", "order")
_CHANGES = ("speed", "option", "receiver")
_SOURCES = ("speed", "option", "sound_source", "receiver")

VARIABLES: Final[dict[str, Variable]] = {
    "shaft_speed": Variable(("speed", "option", "crank_angle"), "rad s-1", "speed of the shaft"),
    "force": Variable((*_FORCES, "crank_angle"), "N", "force of the moving parts on the housing"),
    "moment": Variable(
        (*_FORCES, "crank_angle"), "N m", "moment on the housing about its centre of mass"
    ),
    "force_order": Variable((*_FORCES, "order"), "N", "force order spectrum", True),
    "moment_order": Variable((*_FORCES, "order"), "N m", "moment order spectrum", True),
    "force_amplitude": Variable(
        _ORDERS, "N", "resultant force, semi-major axis of its ellipse, peak"
    ),
    "moment_amplitude": Variable(
        _ORDERS, "N m", "resultant moment, semi-major axis of its ellipse, peak"
    ),
    "reported_figure": Variable(
        ("speed", "option", "figure"), "", "figure of machine, option or source, unit in its name"
    ),
    "velocity_order": Variable(
        ("speed", "option", "source", "dof", "order"), "m s-1", "velocity of the housing", True
    ),
    "block_velocity_order": Variable(
        ("speed", "option", "source", "dof", "order"),
        "m s-1",
        "velocity of the block on its springs in the shell",
        True,
    ),
    "foot_force_order": Variable(
        ("speed", "option", "source", "foot", "axis", "order"), "N", "force into the foot", True
    ),
    "foot_force_amplitude": Variable(
        ("speed", "option", "foot", "order"), "N", "force into the foot, semi-major axis, peak"
    ),
    "natural_frequency": Variable(("mode",), "Hz", "natural frequency on the mounts"),
    "mode_shape": Variable(("mode", "body", "dof"), "kg-1/2", "mass-normalised shape of the mode"),
    "mount_transmissibility": Variable(
        ("axis", "mount_frequency"), "1", "sum of foot forces per force at the centre of mass", True
    ),
    "transfer_vector": Variable(
        ("receiver", "dof", "frequency"), "Pa s m-1", "pressure per velocity of the housing", True
    ),
    "transfer_vector_closed_form": Variable(
        ("receiver", "dof", "frequency"),
        "Pa s m-1",
        "pressure per velocity, with the closed-form Green's function",
        True,
    ),
    "transfer_vector_error": Variable(
        ("receiver", "dof", "frequency"),
        "Pa s m-1",
        "estimated standard error of the transfer vector from the grids",
    ),
    "pattern_transfer_vector": Variable(
        ("receiver", "pattern", "frequency"),
        "Pa s m-1",
        "pressure per unit of a surface velocity given by a file",
        True,
    ),
    "pattern_transfer_vector_error": Variable(
        ("receiver", "pattern", "frequency"),
        "Pa s m-1",
        "estimated standard error of the pattern's transfer vector from the grids",
    ),
    "map_transfer_vector": Variable(
        ("map_row", "map_column", "dof", "line_frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing on the map",
        True,
    ),
    "directivity_transfer_vector": Variable(
        ("polar_angle", "azimuth", "dof", "line_frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing around the machine",
        True,
    ),
    "surface_transfer_vector": Variable(
        ("position", "dof", "frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing on the measurement surface",
        True,
    ),
    "map_level": Variable(
        ("speed", "option", "map_row", "map_column"), "dB", "level of the 1x line on the map"
    ),
    "order_sound_power_level": Variable(
        ("speed", "option", "order", "weighting"), "dB", "sound power level of a shaft order"
    ),
    "sound_power_level": Variable(
        ("speed", "option", "weighting"), "dB", "sound power level of all modelled orders"
    ),
    "unit_sound_power_level": Variable(
        ("dof", "frequency"), "dB", "sound power level at 1 mm/s or 1 mrad/s, root mean square"
    ),
    "green_difference": Variable(
        ("receiver", "frequency"), "dB", "k-Wave's Green's function against the closed form"
    ),
    "line_difference": Variable(
        _CHANGES, "dB", "1x level with k-Wave's Green's function against the closed form"
    ),
    "pressure_line": Variable(
        ("speed", "option", "sound_source", "receiver", "line"), "Pa", "sound pressure", True
    ),
    "order_level": Variable(
        ("speed", "option", "receiver", "order", "weighting"), "dB", "level of a shaft order"
    ),
    "level_modelled": Variable(
        ("speed", "option", "receiver", "weighting"), "dB", "level of all modelled sources"
    ),
    "level_total": Variable(_CHANGES, "dB", "A-weighted level with the unmodelled remainder"),
    "level_remainder": Variable((), "dB", "A-weighted level that the model does not explain"),
    "change_1x": Variable(_CHANGES, "dB", "change of the 1x line against none"),
    "change_modelled": Variable(_CHANGES, "dB", "change of the modelled A-weighted level"),
    "change_total": Variable(_CHANGES, "dB", "change of the A-weighted total level"),
    "criterion_value": Variable(("option", "criterion"), "", "criterion, unit in criterion_unit"),
    "given_value": Variable(
        ("option", "given_criterion"), "", "value that the study gives, not a number where none"
    ),
    "weight": Variable(("criterion",), "1", "weight of the criterion"),
    "criterion_best": Variable(("criterion",), "", "value that counts as best, utility 1"),
    "criterion_worst": Variable(("criterion",), "", "value that counts as worst, utility 0"),
    "score": Variable(("option", "scoring_method"), "1", "score, 0 worst to 1 best"),
    "rank": Variable(("option", "scoring_method"), "1", "rank, 1 is best"),
    "first_place_share": Variable(
        ("option",), "1", "share of random weightings in which the option ranks first"
    ),
    "signal": Variable(("channel", "time"), "", "recorded samples, unit in channel_unit"),
    "channel_order": Variable(
        ("channel", "speed", "order"),
        "",
        "shaft order, coherent mean over the blocks at the speed, unit in channel_unit",
        True,
    ),
    "channel_order_rms": Variable(
        ("channel", "speed", "order"),
        "",
        "root mean square in the order's band, unit in channel_unit",
    ),
    "channel_order_coherence": Variable(
        ("channel", "speed", "order"), "1", "power of the coherent mean over the mean power"
    ),
    "block_order": Variable(
        ("channel", "block", "order"), "", "shaft order, unit in channel_unit", True
    ),
    "block_order_rms": Variable(
        ("channel", "block", "order"),
        "",
        "root mean square in the order's band, unit in channel_unit",
    ),
    "mean_order_spectrum": Variable(
        ("channel", "map_order"),
        "",
        "root mean square of each line, mean power over the blocks, unit in channel_unit",
    ),
    "order_map": Variable(
        ("channel", "block", "map_order"), "", "order spectra, unit in channel_unit", True
    ),
    "synchronous_average": Variable(
        ("channel", "average_angle"), "", "mean over the revolutions, unit in channel_unit"
    ),
    "synchronous_average_error": Variable(
        ("channel", "average_angle"), "", "standard error of the mean, unit in channel_unit"
    ),
    "equivalent_level": Variable(("channel", "weighting"), "dB", "equivalent level"),
    "fast_maximum_level": Variable(("channel", "weighting"), "dB", "greatest Fast level"),
    "slow_maximum_level": Variable(("channel", "weighting"), "dB", "greatest Slow level"),
    "band_level": Variable(
        ("channel", "weighting", "band"), "dB", "equivalent level in a third of an octave"
    ),
    "fault_time": Variable(("fault",), "s", "time of the fault"),
    "compared_order": Variable(
        ("channel", "speed", "order"), "", "shaft order in the other result", True
    ),
    "order_difference": Variable(
        ("channel", "speed", "order"), "dB", "level of the order in the other result minus this"
    ),
    "order_phase_difference": Variable(
        ("channel", "speed", "order"), "rad", "phase of the order in the other result minus this"
    ),
    "source_level": Variable(_SOURCES, "dB", "A-weighted level of a source alone"),
    "source_share": Variable(_SOURCES, "1", "share of the A-weighted energy of all sources"),
    "source_band_level": Variable((*_SOURCES, "band"), "dB", "level of a source in a third-octave"),
    "source_level_by_draw": Variable(
        ("draw", *_SOURCES), "dB", "A-weighted level of a source alone"
    ),
    "level_modelled_by_draw": Variable(
        ("draw", *_CHANGES), "dB", "A-weighted level of all modelled sources"
    ),
    "level_total_by_draw": Variable(
        ("draw", *_CHANGES), "dB", "A-weighted level with the draw's own remainder"
    ),
    "level_remainder_by_draw": Variable(
        ("draw",), "dB", "A-weighted level that the draw leaves unexplained"
    ),
    "draw_weight": Variable(("draw",), "1", "weight of the draw; 0 where it is left out"),
    "drawn_value": Variable(("draw", "drawn_parameter"), "", "drawn value, SI unit in the name"),
    "stopping_duration": Variable(("speed",), "s", "time from switch-off to rest"),
    "stopping_revolutions": Variable(("speed",), "1", "revolutions from switch-off to rest"),
    "stopping_shaft_speed": Variable(
        ("speed", "stopping_time"), "rad s-1", "speed of the shaft around a stop"
    ),
    "stopping_force": Variable(
        ("speed", "axis", "stopping_time"), "N", "force on the housing around a stop"
    ),
    "stopping_moment": Variable(
        ("speed", "axis", "stopping_time"),
        "N m",
        "moment on the housing about its centre of mass around a stop",
    ),
    "stopping_pressure": Variable(
        ("speed", "receiver", "stopping_time"), "Pa", "sound pressure around a stop"
    ),
    "stopping_fast_level": Variable(
        ("speed", "receiver", "stopping_time"), "dB", "A-weighted Fast level around a stop"
    ),
    "stopping_fast_maximum_level": Variable(
        ("stopping_phase", "speed", "receiver"), "dB", "greatest A-weighted Fast level"
    ),
    "stopping_peak_level": Variable(
        ("stopping_phase", "speed", "receiver"), "dB", "level of the largest unweighted pressure"
    ),
    "stopping_foot_force": Variable(
        ("stopping_phase", "speed"), "N", "largest force into a foot, static part excluded"
    ),
    "stopping_order_map": Variable(
        ("axis", "stopping_block", "map_order"),
        "N",
        "order spectra of the force on the housing in a stop without gas load, peak",
    ),
    "column_value": Variable(
        ("column", "option", "speed", "receiver"), "", "further column of the comparison"
    ),
    "published_score": Variable(
        ("published_option", "published_criterion"), "1", "published score, as printed"
    ),
    "published_sum": Variable(("published_option",), "1", "published sum, as printed"),
    "recomputed_sum": Variable(("published_option",), "1", "sum of the published scores"),
}


def stamp(
    name: str, values: Any, coords: Mapping[str, Any] | None = None, **attrs: str
) -> xr.DataArray:
    """Label an array as the vocabulary's variable `name`.

    Parameters
    ----------
    name : a key of VARIABLES; it fixes the dims and the unit
    values : array whose shape follows those dims
    coords : coordinate values by name
    attrs : further attributes, such as `source`

    Raises
    ------
    SchemaError
        The name is unknown or the number of dimensions does not fit.
    """
    variable = _look_up(name)
    array = np.asarray(values)
    if array.ndim != len(variable.dims):
        raise SchemaError(f"{name}: has {array.ndim} dimensions, needs {variable.dims}")
    labelled = xr.DataArray(array, dims=variable.dims, coords=coords, name=name)
    labelled.attrs = {"units": variable.units, "long_name": variable.long_name, **attrs}
    if variable.complex_peak:
        labelled.attrs["phasor"] = "complex peak, x(t) = Re{X exp(+j w t)}"
    if "dof" in variable.dims:
        labelled.attrs["note"] = (
            "unit of the translations; rotations per m" if name == "mode_shape" else DOF_UNIT_NOTE
        )
    return labelled


def check(dataset: xr.Dataset, required: Sequence[str] = ()) -> xr.Dataset:
    """Return the dataset if all of its variables obey the vocabulary.

    Raises
    ------
    SchemaError
        A variable is unknown, missing, has other dims or another unit, or is complex where
        it must not be.
    """
    for name in required:
        if name not in dataset:
            raise SchemaError(f"variable {name} is missing")
    for key, array in dataset.data_vars.items():
        _check_variable(str(key), array)
    for key in dataset.coords:
        if str(key) not in COORDINATES:
            raise SchemaError(f"coordinate {key} is not in the vocabulary")
    return dataset


def label_coordinates(dataset: xr.Dataset) -> xr.Dataset:
    """Give every coordinate its unit and long name."""
    for name, coordinate in dataset.coords.items():
        variable = COORDINATES.get(str(name))
        if variable is None:
            raise SchemaError(f"coordinate {name} is not in the vocabulary")
        coordinate.attrs = {"long_name": variable.long_name}
        if variable.units:
            coordinate.attrs["units"] = variable.units
    return dataset


def _look_up(name: str) -> Variable:
    try:
        return VARIABLES[name]
    except KeyError:
        raise SchemaError(f"variable {name} is not in the vocabulary") from None


def _check_variable(name: str, array: xr.DataArray) -> None:
    variable = _look_up(name)
    if array.dims != variable.dims:
        raise SchemaError(f"{name}: dims are {array.dims}, must be {variable.dims}")
    if array.attrs.get("units") != variable.units:
        raise SchemaError(
            f"{name}: unit is {array.attrs.get('units')!r}, must be {variable.units!r}"
        )
    if np.iscomplexobj(array.data) != variable.complex_peak:
        raise SchemaError(f"{name}: must {'' if variable.complex_peak else 'not '}be complex")
