"""Recordings over their speed: tracked orders, spectra and levels."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("track_time", ("track_time",), "s", "time from the start of the recording"),
    Coordinate("track_speed", ("track_time",), "rpm", "speed of the shaft"),
    Coordinate("map_frequency", ("map_frequency",), "Hz", "frequency of a spectrum's line"),
    Variable(
        "tracked_order",
        ("channel", "track_time", "order"),
        "",
        "envelope of a tracked shaft order, unit in channel_unit",
        complex_peak=True,
    ),
    Variable(
        "speed_frequency_map",
        ("channel", "block", "map_frequency"),
        "",
        "spectra, unit in channel_unit",
        complex_peak=True,
    ),
    Variable("block_level", ("channel", "block", "weighting"), "dB", "level over the block"),
):
    register(_thing)
