"""Sound of the machine in a room: at its listeners, by air and by the feet, and over a plane."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_CASES: Final = ("speed", "option", "listener")
_SEAM: Final = ("listener", "seam_band")

for _coordinate in (
    Coordinate("seam_band", ("seam_band",), "Hz", "third octave around the change of method"),
    Coordinate("room_octave", ("room_octave",), "Hz", "octave of the room's absorption"),
    Coordinate("room_surface", ("room_surface",), "", "wall, furniture or patch of a room"),
    Coordinate("room_limit_time", ("room_limit_time",), "", "time of day of a limit"),
    Coordinate("room_map_x", ("room_map_x",), "m", "along the room, from its corner"),
    Coordinate("room_map_y", ("room_map_y",), "m", "across the room, from its corner"),
):
    register(_coordinate)

for _thing in (
    Variable("room_level", _CASES, "dB", "A-weighted level of the machine by air in the room"),
    Variable("room_level_low", _CASES, "dB", "A-weighted level that 5 % of the draws stay below"),
    Variable(
        "room_level_middle", _CASES, "dB", "A-weighted level that half of the draws stay below"
    ),
    Variable("room_level_high", _CASES, "dB", "A-weighted level that 95 % of the draws stay below"),
    Variable(
        "room_source_level",
        (*_CASES, "sound_source"),
        "dB",
        "A-weighted level of a source by air in the room",
    ),
    Variable(
        "room_band_level",
        (*_CASES, "noise_band"),
        "dB",
        "level of the machine by air in the room in third octaves",
    ),
    Variable(
        "room_pressure_line",
        (*_CASES, "line"),
        "Pa",
        "pressure of all sources by air at a line in the room",
        complex_peak=True,
    ),
    Variable(
        "room_noise_band_level",
        (*_CASES, "noise_band"),
        "dB",
        "unweighted level by air in the room of what is no tone: noise of all sources and what no "
        "source explains",
    ),
    Variable(
        "room_sound_power_level",
        ("speed", "option"),
        "dB",
        "A-weighted sound power level of the machine on a hard floor in the open",
    ),
    Variable(
        "room_plate_level",
        _CASES,
        "dB",
        "A-weighted level by the feet and the plate in the room",
    ),
    Variable(
        "room_plate_line_level",
        (*_CASES, "line"),
        "dB",
        "level of a line by the feet and the plate in the room",
    ),
    Variable(
        "room_plate_level_low",
        _CASES,
        "dB",
        "A-weighted level by the feet and the plate in the room that 5 % of such plates stay below",
    ),
    Variable(
        "room_plate_level_high",
        _CASES,
        "dB",
        "A-weighted level by the feet and the plate in the room that 95 % of such plates stay "
        "below",
    ),
    Variable(
        "room_level_both_ways",
        _CASES,
        "dB",
        "A-weighted level in the room by air, the middle of the draws where there are some, and by "
        "the feet and the plate",
    ),
    Variable(
        "room_gain_waves",
        _SEAM,
        "dB",
        "level at a listener over the sound power level, by waves",
    ),
    Variable(
        "room_gain_diffuse",
        _SEAM,
        "dB",
        "level at a listener over the sound power level, by direct sound and diffuse field",
    ),
    Variable(
        "room_gain_difference",
        _SEAM,
        "dB",
        "level at a listener by waves over that by direct sound and diffuse field",
    ),
    Variable(
        "room_place_gain",
        ("seam_band",),
        "dB",
        "sound power at the machine's place over that on a hard floor in the open",
    ),
    Variable(
        "room_place_gain_above",
        (),
        "dB",
        "sound power at the machine's place over that in the open, taken above the waves",
    ),
    Variable("room_absorption_area", ("room_octave",), "m2", "equivalent absorption area"),
    Variable(
        "room_wall_absorption",
        ("room_surface", "room_octave"),
        "1",
        "random-incidence absorption of a surface in the computed waves",
    ),
    Variable(
        "room_wall_absorption_requested",
        ("room_surface", "room_octave"),
        "1",
        "random-incidence absorption of a surface in the study",
    ),
    Variable("room_limit", ("room_limit_time",), "dB", "A-weighted level that listeners accept"),
    Variable(
        "room_map_gain",
        ("room_map_y", "room_map_x", "seam_band"),
        "dB",
        "level of a monopole over its power level on a hard floor in the open",
    ),
    Variable(
        "room_map_level",
        ("room_map_y", "room_map_x"),
        "dB",
        "A-weighted level by air of a monopole of the machine's power, by waves alone",
    ),
):
    register(_thing)
