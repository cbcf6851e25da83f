"""Recordings: samples, orders and levels of each channel."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("channel", ("channel",), "", "channel of a recording"),
    Coordinate("channel_unit", ("channel",), "", "unit of the channel's samples"),
    Coordinate(
        "calibration_factor",
        ("channel",),
        "",
        "channel's unit per unit stored in the file, already applied",
    ),
    Coordinate("time", ("time",), "s", "time from the start of the recording"),
    Coordinate("block", ("block",), "1", "block of revolutions of a recording"),
    Coordinate("block_time", ("block",), "s", "middle of the block"),
    Coordinate("block_speed", ("block",), "rpm", "mean speed over the block"),
    Coordinate("block_count", ("speed",), "1", "blocks at the speed"),
    Coordinate("map_order", ("map_order",), "1", "shaft order"),
    Coordinate("average_angle", ("average_angle",), "rad", "crank angle over a revolution"),
    Coordinate("fault", ("fault",), "", "missing or double pulse of the tacho"),
    Variable("signal", ("channel", "time"), "", "recorded samples, unit in channel_unit"),
    Variable(
        "channel_order",
        ("channel", "speed", "order"),
        "",
        "shaft order, coherent mean over the blocks at the speed, unit in channel_unit",
        complex_peak=True,
    ),
    Variable(
        "channel_order_rms",
        ("channel", "speed", "order"),
        "",
        "root mean square in the order's band, unit in channel_unit",
    ),
    Variable(
        "channel_order_coherence",
        ("channel", "speed", "order"),
        "1",
        "power of the coherent mean over the mean power",
    ),
    Variable(
        "block_order",
        ("channel", "block", "order"),
        "",
        "shaft order, unit in channel_unit",
        complex_peak=True,
    ),
    Variable(
        "block_order_rms",
        ("channel", "block", "order"),
        "",
        "root mean square in the order's band, unit in channel_unit",
    ),
    Variable(
        "mean_order_spectrum",
        ("channel", "map_order"),
        "",
        "root mean square of each line, mean power over the blocks, unit in channel_unit",
    ),
    Variable(
        "order_map",
        ("channel", "block", "map_order"),
        "",
        "order spectra, unit in channel_unit",
        complex_peak=True,
    ),
    Variable(
        "synchronous_average",
        ("channel", "average_angle"),
        "",
        "mean over the revolutions, unit in channel_unit",
    ),
    Variable(
        "synchronous_average_error",
        ("channel", "average_angle"),
        "",
        "standard error of the mean, unit in channel_unit",
    ),
    Variable("equivalent_level", ("channel", "weighting"), "dB", "equivalent level"),
    Variable("fast_maximum_level", ("channel", "weighting"), "dB", "greatest Fast level"),
    Variable("slow_maximum_level", ("channel", "weighting"), "dB", "greatest Slow level"),
    Variable(
        "band_level",
        ("channel", "weighting", "band"),
        "dB",
        "equivalent level in a third of an octave",
    ),
    Variable("fault_time", ("fault",), "s", "time of the fault"),
):
    register(_thing)
