"""Green's functions of a room: one run a microphone, by reciprocity."""

from collections.abc import Mapping, Sequence

from ...base.errors import ParameterError
from ...base.progress import Progress, no_progress
from ..arrays import Array
from .cutting import cut, faces
from .decay import reverberation_time_s
from .lattice import Lattice, holding
from .room import Room
from .run import RoomResponse, run_all
from .settings import RoomSettings


def room_transfer(
    room: Room,
    lattices: Sequence[Lattice],
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    settings: RoomSettings | None = None,
    gradient: bool = False,
    progress: Progress = no_progress,
    workers: int | None = None,
) -> dict[str, RoomResponse]:
    """Green's functions between microphones and points of a room, by microphone.

    A monopole at the microphone gives those of all points towards it (reciprocity). Pressure is
    read off the series: points and microphones may lie anywhere in the air, but points nearer to
    the microphone than two spacings see a monopole that the series blurs.

    Parameters
    ----------
    room : its origin is the origin of all coordinates
    lattices : of points, such as those of `join_lattices`
    microphones : (3,) by name, m
    frequency_hz : (frequency,), up to the settings' highest
    settings : spacing and duration
    gradient : whether derivatives are asked for, too
    progress : reports steps done
    workers : microphones at a time; None: as many as there are processors

    Raises
    ------
    ParameterError
        A microphone or a point lies in a block, a gap is too thin, or a frequency too high.
    SolverError
        The pressure is no finite number.
    """
    settings = settings or RoomSettings()
    if frequency_hz.size and frequency_hz.max() > settings.maximum_frequency_hz * (1.0 + 1e-9):
        raise ParameterError(
            f"room: {frequency_hz.max():g} Hz is asked for; the room is computed to "
            f"{settings.maximum_frequency_hz:g} Hz"
        )
    boxes = cut(room, settings.spacing_m)
    for name, position in microphones.items():
        holding(boxes, position, f"microphones.{name}")
    longest = settings.longest_s or reverberation_time_s(room)
    return run_all(
        boxes, faces(room, boxes), lattices, gradient, microphones, frequency_hz, settings, longest,
        progress, workers,
    )  # fmt: skip
