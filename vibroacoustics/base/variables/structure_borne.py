"""Sound of a plate under the feet: power into it and out of it, levels at the microphones."""

from typing import Final

from ..registry import register
from ..vocabulary import Variable

_LINES: Final = ("speed", "option", "line")
_RECEIVERS: Final = ("speed", "option", "receiver")

for _thing in (
    Variable("structure_borne_input_power", _LINES, "W", "power of the feet into the plate"),
    Variable("structure_borne_power", _LINES, "W", "sound power of the plate to one side"),
    Variable(
        "structure_borne_line_level",
        (*_RECEIVERS, "line", "weighting"),
        "dB",
        "level of a line by the feet and the plate",
    ),
    Variable(
        "structure_borne_line_low",
        _LINES,
        "dB",
        "level that 5 % of such plates stay below, over that of the mean power",
    ),
    Variable(
        "structure_borne_line_high",
        _LINES,
        "dB",
        "level that 95 % of such plates stay below, over that of the mean power",
    ),
    Variable(
        "structure_borne_level",
        (*_RECEIVERS, "weighting"),
        "dB",
        "level of all lines by the feet and the plate",
    ),
    Variable(
        "structure_borne_level_low",
        _RECEIVERS,
        "dB",
        "A-weighted level by the feet and the plate that 5 % of such plates stay below",
    ),
    Variable(
        "structure_borne_level_high",
        _RECEIVERS,
        "dB",
        "A-weighted level by the feet and the plate that 95 % of such plates stay below",
    ),
    Variable(
        "level_both_ways",
        _RECEIVERS,
        "dB",
        "A-weighted level of the machine by air and of the plate under its feet together",
    ),
):
    register(_thing)
