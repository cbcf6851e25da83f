"""Levels by source of the sound."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_SOURCES: Final = ("speed", "option", "sound_source", "receiver")

for _thing in (
    Coordinate("sound_source", ("sound_source",), "", "what makes the sound"),
    Variable("source_level", _SOURCES, "dB", "A-weighted level of a source alone"),
    Variable("source_share", _SOURCES, "1", "share of the A-weighted energy of all sources"),
    Variable("source_band_level", (*_SOURCES, "band"), "dB", "level of a source in a third-octave"),
):
    register(_thing)
