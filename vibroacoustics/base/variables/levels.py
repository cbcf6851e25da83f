"""Sound pressure by line, levels, and what the options change."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_CHANGES: Final = ("speed", "option", "receiver")

for _thing in (
    Coordinate("weighting", ("weighting",), "", "frequency weighting (IEC 61672-1)"),
    Coordinate("band", ("band",), "Hz", "nominal midband frequency of a third of an octave"),
    Coordinate("line", ("line",), "", "order or other tone"),
    Coordinate("tone_frequency", ("speed", "line"), "Hz", "frequency of a line; empty without it"),
    Coordinate("line_order", ("line",), "1", "shaft order of a line; empty where it is none"),
    Variable(
        "pressure_line",
        ("speed", "option", "sound_source", "receiver", "line"),
        "Pa",
        "sound pressure",
        complex_peak=True,
    ),
    Variable(
        "order_level",
        ("speed", "option", "receiver", "order", "weighting"),
        "dB",
        "level of a shaft order",
    ),
    Variable(
        "level_modelled",
        ("speed", "option", "receiver", "weighting"),
        "dB",
        "level of all modelled sources",
    ),
    Variable("level_total", _CHANGES, "dB", "A-weighted level with the unmodelled remainder"),
    Variable("level_remainder", (), "dB", "A-weighted level that the model does not explain"),
    Coordinate(
        "noise_band",
        ("noise_band",),
        "Hz",
        "nominal midband frequency of a third of an octave of what is no tone",
    ),
    Variable(
        "noise_band_level",
        (*_CHANGES, "noise_band"),
        "dB",
        "unweighted level of the noise of all sources",
    ),
    Variable(
        "remainder_band_level",
        ("speed", "option", "noise_band"),
        "dB",
        "unweighted level of what the model does not explain, where no baseline stands for it",
    ),
    Variable("change_1x", _CHANGES, "dB", "change of the 1x line against none"),
    Variable("change_modelled", _CHANGES, "dB", "change of the modelled A-weighted level"),
    Variable("change_total", _CHANGES, "dB", "change of the A-weighted total level"),
):
    register(_thing)
