"""What the waves of a study's room will take: a few steps of its air are timed."""

from math import ceil
from typing import Final

from ...study.room import StudyRoom
from ..cost import Cost, processor_time_s
from .air import stable_air
from .cutting import cut, faces
from .decay import reverberation_time_s
from .lattice import holding
from .of_study import listeners_m, room_of
from .settings import RoomSettings

_STEPS: Final = 50
_LOW: Final = 0.5
"""Runs may end before the reverberation time."""
_HIGH: Final = 2.0
"""Points around the machine and over the map are read, too."""
_MACHINE_S: Final = (3.0, 40.0)
"""The machine's field on the box around it and on the hemisphere (seen, not derived)."""


def room_cost(settings: StudyRoom) -> Cost:
    """A run for each listener and one for the map, and the machine's field.

    Parameters
    ----------
    settings : of the room
    """
    room, waves = room_of(settings), RoomSettings(settings.maximum_frequency_hz)
    boxes = cut(room, waves.spacing_m)
    air = stable_air(boxes, faces(room, boxes), waves.longest_step_s)
    first = next(iter(listeners_m(settings).values()))
    air.set_source(holding(boxes, first), first)

    def some() -> None:
        for _ in range(_STEPS):
            air.exchange(0.0)
            air.advance(0.0)

    some()  # compiles
    steps = ceil(reverberation_time_s(room) / air.time_step_s)
    seconds = processor_time_s(some) / _STEPS * steps
    runs = len(settings.listeners) + 1
    how = f"{runs} runs of {steps} steps at most, some steps measured"
    low, high = _MACHINE_S
    return Cost("room", low + _LOW * runs * seconds, high + _HIGH * runs * seconds, how)
