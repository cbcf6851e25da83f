"""Cost of the waves of a study's room: a few steps of its air are timed."""

from math import ceil
from typing import Final

from ...study.room import StudyRoom
from ...study.study import Study
from ..cost import Cost, processor_time_s
from .air import stable_air
from .cutting import cut, faces
from .diffuse import reverberation_time_s
from .lattice import holding
from .machine_in_room import placed
from .of_study import foot_m, listeners_m, room_of
from .settings import RoomSettings

_STEPS: Final = 50
_LOW: Final = 0.5
"""Runs may end before the reverberation time."""
_HIGH: Final = 2.0
"""Points around the machine and over the map are read, too."""
_MACHINE_S: Final = (3.0, 40.0)
"""The machine's field on the box around it and on the hemisphere: 7 s were measured with the rigid
motions of a compressor on its floor, some 20 s with the modes of its shell."""


def room_cost(study: Study, settings: StudyRoom) -> Cost:
    """A run for each listener and one for the map, and the machine's field."""
    waves, ears = RoomSettings(settings.maximum_frequency_hz), listeners_m(settings)
    shell, radiation = study.machine.shell, study.radiation
    _, stands = placed(shell, radiation, room_of(settings), foot_m(settings), ears, waves)
    room = stands.room
    boxes = cut(room, waves.spacing_m)
    air = stable_air(boxes, faces(room, boxes), waves.longest_step_s, waves.maximum_frequency_hz)
    first = next(iter(ears.values()))
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
