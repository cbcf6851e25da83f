"""A stop: motion, force and sound around switch-off."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("stopping_time", ("stopping_time",), "s", "time from switch-off"),
    Coordinate("stopping_phase", ("stopping_phase",), "", "before or after switch-off"),
    Coordinate("stopping_block", ("stopping_block",), "1", "block of revolutions of the run-down"),
    Coordinate("stopping_block_time", ("stopping_block",), "s", "middle of the block"),
    Coordinate("stopping_block_speed", ("stopping_block",), "rpm", "mean speed over the block"),
    Variable("stopping_duration", ("speed",), "s", "time from switch-off to rest"),
    Variable("stopping_revolutions", ("speed",), "1", "revolutions from switch-off to rest"),
    Variable(
        "stopping_turned_back_angle",
        ("speed",),
        "rad",
        "angle that the shaft turns back before it stands",
    ),
    Variable(
        "stopping_brake_force",
        ("speed",),
        "N",
        "largest force of the brake around the shaft when it jams",
    ),
    Variable(
        "stopping_shaft_speed",
        ("speed", "stopping_time"),
        "rad s-1",
        "speed of the shaft around a stop",
    ),
    Variable(
        "stopping_force",
        ("speed", "axis", "stopping_time"),
        "N",
        "force on the housing around a stop",
    ),
    Variable(
        "stopping_moment",
        ("speed", "axis", "stopping_time"),
        "N m",
        "moment on the housing about its centre of mass around a stop",
    ),
    Variable(
        "stopping_pressure",
        ("speed", "receiver", "stopping_time"),
        "Pa",
        "sound pressure around a stop",
    ),
    Variable(
        "stopping_fast_level",
        ("speed", "receiver", "stopping_time"),
        "dB",
        "A-weighted Fast level around a stop",
    ),
    Variable(
        "stopping_fast_maximum_level",
        ("stopping_phase", "speed", "receiver"),
        "dB",
        "greatest A-weighted Fast level",
    ),
    Variable(
        "stopping_peak_level",
        ("stopping_phase", "speed", "receiver"),
        "dB",
        "level of the largest unweighted pressure",
    ),
    Variable(
        "stopping_foot_force",
        ("stopping_phase", "speed"),
        "N",
        "largest force into a foot, static part excluded",
    ),
    Variable(
        "stopping_order_map",
        ("axis", "stopping_block", "map_order"),
        "N",
        "order spectra of the force on the housing in a stop without gas load, peak",
    ),
):
    register(_thing)
