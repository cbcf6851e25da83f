"""How the first sound of the machine of a study comes to the listeners in its room."""

from dataclasses import dataclass

import numpy as np

from ...study.room import StudyRoom
from ..arrays import Array
from .diffuse import direct_per_power, line_of_sight
from .of_study import listeners_m, room_of


@dataclass(frozen=True)
class Arrivals:
    """First sound at the listeners.

    Attributes
    ----------
    distance_m : from the source, also where furniture hides it, shape (listener,)
    per_power : mean square of the direct sound per power, 0 without sight, shape (listener,), Pa²/W
    """

    distance_m: Array
    per_power: Array


def arrivals(settings: StudyRoom, source_m: Array) -> Arrivals:
    """First sound of a source at the listeners.

    Parameters
    ----------
    settings : of the room
    source_m : where the sound comes from, shape (3,)
    """
    room, ears_m = room_of(settings), list(listeners_m(settings).values())
    away = np.array([np.linalg.norm(at - source_m) for at in ears_m])
    seen = [line_of_sight(room, source_m, at) for at in ears_m]
    direct = [direct_per_power(float(far), one) for far, one in zip(away, seen, strict=True)]
    return Arrivals(away, np.array(direct))
