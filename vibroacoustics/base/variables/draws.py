"""Values drawn from their ranges, and the levels that follow."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_CHANGES: Final = ("speed", "option", "receiver")
_SOURCES: Final = ("speed", "option", "sound_source", "receiver")

for _thing in (
    Coordinate("draw", ("draw",), "1", "random set of values"),
    Coordinate("prior", ("prior",), "", "what is held of the remainder before"),
    Coordinate("bank_draw", ("bank_draw",), "1", "set of values at the published level's point"),
    Coordinate("drawn_parameter", ("drawn_parameter",), "", "value that is drawn, SI unit in name"),
    Variable(
        "source_level_by_draw", ("draw", *_SOURCES), "dB", "A-weighted level of a source alone"
    ),
    Variable(
        "level_modelled_by_draw",
        ("draw", *_CHANGES),
        "dB",
        "A-weighted level of all modelled sources",
    ),
    Variable(
        "level_total_by_draw",
        ("draw", *_CHANGES),
        "dB",
        "A-weighted level with the draw's own remainder",
    ),
    Variable(
        "force_1x_by_draw", ("draw", "speed", "option"), "N", "force on the housing at 1x, peak"
    ),
    Variable("moment_1x_by_draw", ("draw", "speed", "option"), "N m", "moment at 1x, peak"),
    Variable(
        "foot_force_1x_by_draw",
        ("draw", "speed", "option"),
        "N",
        "largest force into a foot at 1x, peak",
    ),
    Variable(
        "level_remainder_by_draw",
        ("prior", "draw"),
        "dB",
        "A-weighted level of the draw's remainder",
    ),
    Variable(
        "draw_weight", ("prior", "draw"), "1", "weight of the draw; 0 where it has no solution"
    ),
    Coordinate("knowledge", ("knowledge",), "", "what is known: the ranges, or the level too"),
    Coordinate("unknown", ("unknown",), "", "drawn value, or the level of the remainder"),
    Variable(
        "level_share",
        ("knowledge", "drawn_parameter"),
        "1",
        "share of first order in the variance of the modelled level at the published one's point",
    ),
    Variable("level_share_quality", ("knowledge",), "1", "Q2 of the fit of level_share"),
    Variable(
        "change_share",
        ("option", "unknown"),
        "1",
        "share of first order in the variance of the change of the total",
    ),
    Variable("change_share_quality", ("option",), "1", "Q2 of the fit of change_share"),
    Variable("change_variance", ("option",), "1", "of the change of the total in dB, dB2"),
    Variable("bank_weight", ("prior", "bank_draw"), "1", "how well it agrees with the level"),
    Variable("bank_level", ("bank_draw",), "dB", "A-weighted level of all modelled sources"),
    Variable("bank_value", ("bank_draw", "drawn_parameter"), "", "value, SI unit in the name"),
    Variable("drawn_value", ("draw", "drawn_parameter"), "", "drawn value, SI unit in the name"),
    Variable(
        "projection_error",
        ("drawn_parameter",),
        "1",
        "largest relative error of a natural frequency by projection; empty where exact",
    ),
    Coordinate("shell_draw", ("shell_draw",), "1", "set of values held against hammer tests"),
    Coordinate("shell_parameter", ("shell_parameter",), "", "value of the shell that is drawn"),
    Coordinate("shell_peak", ("shell_peak",), "Hz", "clear peak of the measured mobilities"),
    Variable("shell_likelihood", ("shell_draw",), "1", "how well its shell agrees with the tests"),
    Variable("shell_gain", ("shell_draw",), "dB", "mean level of mobilities over those measured"),
    Variable(
        "shell_frequency_ratio", ("shell_draw",), "1", "natural frequencies over those measured"
    ),
    Variable("shell_loss_ratio", ("shell_draw",), "1", "loss factors over those measured"),
    Variable("shell_value", ("shell_draw", "shell_parameter"), "", "value, SI unit in the name"),
    Variable("shell_peak_loss", ("shell_peak",), "1", "loss factor of a measured peak"),
    Variable(
        "shell_level_before",
        ("shell_level_draw",),
        "dB",
        "A-weighted level of all modelled sources by the ranges alone",
    ),
    Coordinate("shell_level_draw", ("shell_level_draw",), "1", "set of values by the ranges alone"),
    Variable("shell_weight", ("bank_draw",), "1", "weight by the hammer tests alone"),
):
    register(_thing)
