"""A machine in a room."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("listener", ("listener",), "", "place where one listens in a room"),
    Coordinate("room_frequency", ("room_frequency",), "Hz", "frequency of waves in a room"),
    Coordinate(
        "hemisphere_position",
        ("hemisphere_position",),
        "1",
        "microphone position on a hemisphere over a hard floor",
    ),
    Variable(
        "room_transfer_vector",
        ("listener", "pattern", "room_frequency"),
        "Pa s m-1",
        "pressure in the room, by waves, per velocity of the housing",
        complex_peak=True,
    ),
    Variable(
        "room_green_of_foot",
        ("listener", "room_frequency"),
        "m-1",
        "Green's function in the room, by waves, from beside the machine's foot",
        complex_peak=True,
    ),
    Variable(
        "hemisphere_transfer_vector",
        ("hemisphere_position", "pattern", "frequency"),
        "Pa s m-1",
        "pressure on a hemisphere over a hard floor per velocity of the housing",
        complex_peak=True,
    ),
    Variable(
        "room_impulse_response",
        ("listener", "dof", "time"),
        "Pa s2 m-1",
        "pressure in the room per acceleration of the housing, of samples to be convolved",
    ),
):
    register(_thing)
