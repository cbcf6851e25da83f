"""Sound around the machine: map, directivity, sound power."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("line_frequency", ("line_frequency",), "Hz", "frequency of the 1x line"),
    Coordinate("position", ("position",), "1", "microphone position on the measurement surface"),
    Coordinate("position_distance", ("position",), "m", "distance from the centre of mass"),
    Coordinate("map_row", ("map_row",), "1", "row of the map"),
    Coordinate("map_column", ("map_column",), "1", "column of the map"),
    Coordinate("map_x", ("map_row", "map_column"), "m", "x from the centre of mass"),
    Coordinate("map_y", ("map_row", "map_column"), "m", "y from the centre of mass"),
    Coordinate("map_z", ("map_row", "map_column"), "m", "z from the centre of mass"),
    Coordinate("polar_angle", ("polar_angle",), "rad", "angle from the upward vertical"),
    Coordinate("azimuth", ("azimuth",), "rad", "angle about the vertical, from x towards y"),
    Variable(
        "map_transfer_vector",
        ("map_row", "map_column", "dof", "line_frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing on the map",
        complex_peak=True,
    ),
    Variable(
        "directivity_transfer_vector",
        ("polar_angle", "azimuth", "dof", "line_frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing around the machine",
        complex_peak=True,
    ),
    Variable(
        "surface_transfer_vector",
        ("position", "dof", "frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing on the measurement surface",
        complex_peak=True,
    ),
    Variable(
        "map_level",
        ("speed", "option", "map_row", "map_column"),
        "dB",
        "level of the 1x line on the map",
    ),
    Variable(
        "order_sound_power_level",
        ("speed", "option", "order", "weighting"),
        "dB",
        "sound power level of a shaft order",
    ),
    Variable(
        "sound_power_level",
        ("speed", "option", "weighting"),
        "dB",
        "sound power level of all modelled orders",
    ),
    Variable(
        "unit_sound_power_level",
        ("dof", "frequency"),
        "dB",
        "sound power level at 1 mm/s or 1 mrad/s, root mean square",
    ),
):
    register(_thing)
