"""Values drawn from their ranges, and the levels that follow."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_CHANGES: Final = ("speed", "option", "receiver")
_SOURCES: Final = ("speed", "option", "sound_source", "receiver")

for _thing in (
    Coordinate("draw", ("draw",), "1", "random set of values"),
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
        "level_remainder_by_draw",
        ("draw",),
        "dB",
        "A-weighted level that the draw leaves unexplained",
    ),
    Variable("draw_weight", ("draw",), "1", "weight of the draw; 0 where it is left out"),
    Variable("drawn_value", ("draw", "drawn_parameter"), "", "drawn value, SI unit in the name"),
    Variable(
        "projection_error",
        ("drawn_parameter",),
        "1",
        "largest relative error of a natural frequency by projection; empty where exact",
    ),
):
    register(_thing)
