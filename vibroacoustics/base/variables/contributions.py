"""Sound by path: source, where it acts and in which direction, to the microphone."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_PATHS: Final = ("path_speed", "option", "path", "receiver")
_MOTIONS: Final = ("path_speed", "option", "radiating_motion", "receiver")

for _thing in (
    Coordinate("path", ("path",), "", "source, port and direction of a path of sound"),
    Coordinate("path_source", ("path",), "", "what makes the sound of the path"),
    Coordinate("path_port", ("path",), "", "where the source acts"),
    Coordinate("path_direction", ("path",), "", "motion, force, moment, wave or flow there"),
    Coordinate("path_speed", ("path_speed",), "rpm", "speed at which paths are told apart"),
    Coordinate("path_order", ("path_order",), "1", "shaft order at which paths are told apart"),
    Variable(
        "path_pressure",
        (*_PATHS, "path_order"),
        "Pa",
        "sound pressure by path; the paths add up to that of all sources",
        complex_peak=True,
    ),
    Coordinate(
        "radiating_motion",
        ("radiating_motion",),
        "",
        "motion of the housing as a rigid body, or mode of its shell",
    ),
    Variable(
        "motion_level",
        _MOTIONS,
        "dB",
        "A-weighted level of all lines of a motion alone, without noise",
    ),
    Variable(
        "motion_share",
        _MOTIONS,
        "1",
        "share of the A-weighted energy of the modelled lines; negative where it works against",
    ),
    Variable("path_level", _PATHS, "dB", "A-weighted level of a path alone"),
    Variable(
        "path_share",
        _PATHS,
        "1",
        "share of the modelled A-weighted energy; negative where a path works against the others",
    ),
    Variable(
        "modelled_band_level",
        ("path_speed", "option", "receiver", "band"),
        "dB",
        "level of all modelled sources in a third-octave",
    ),
    Variable("path_band_level", (*_PATHS, "band"), "dB", "level of a path alone in a third-octave"),
    Variable(
        "path_band_share",
        (*_PATHS, "band"),
        "1",
        "share of the modelled energy of a third-octave; negative where a path works against it",
    ),
):
    register(_thing)
