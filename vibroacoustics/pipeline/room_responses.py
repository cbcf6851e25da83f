"""Impulse responses from the machine of a study to the listeners in its room."""

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import RIGID_BODY_DOFS, check, stamp
from ..radiation.rooms import DiffuseRoom
from ..radiation.rooms import of_study as rooms
from ..radiation.rooms.arrivals import arrivals
from ..sound.rendering import SAMPLE_RATE_HZ
from ..sound.room_responses import WaysOfRoom, room_responses
from ..study.room import StudyRoom
from ..study.study import Study
from . import in_room


def impulse_responses(study: Study, progress: Progress = no_progress) -> xr.DataArray:
    """Sound pressure at the listeners in the room per acceleration of the shell, over time.

    At 48 kHz, per sample: the convolution of a sampled acceleration of a rigid motion with it is
    the pressure that this motion makes. To the seam by waves, above it by direct sound and decaying
    noise of a fixed seed.

    Parameters
    ----------
    study : with its table of the room
    progress : told of the advance

    Returns
    -------
    `room_impulse_response` (listener, dof, time), Pa/(m/s²) and, of rotations about the centre of
    mass, Pa/(rad/s²)

    Raises
    ------
    ParameterError
        The study has no room, or the machine cannot stand in it.

    Examples
    --------
    >>> study = va.load_study("pipelines/kitchen.toml")
    >>> coarse = study.replace({"room.maximum_frequency_hz": 250.0})
    >>> responses = va.impulse_responses(coarse)
    >>> at_table = responses.sel(listener="table", dof="tz")
    """
    settings = study.room
    if settings is None:
        raise ParameterError("room: the study has none; impulse responses are those of a room")
    vectors, _ = in_room.vectors_of(study, settings, (), progress)
    responses = room_responses(_ways(study, settings, vectors))
    coords = {
        "listener": list(settings.listeners),
        "dof": list(RIGID_BODY_DOFS),
        "time": np.arange(responses.shape[-1]) / SAMPLE_RATE_HZ,
    }
    labelled = stamp("room_impulse_response", responses, coords)
    return check(xr.Dataset({"room_impulse_response": labelled}))["room_impulse_response"]


def _ways(study: Study, settings: StudyRoom, vectors: xr.Dataset) -> WaysOfRoom:
    shell, pressure = study.machine.shell, rooms.pressure_at_places(vectors)
    both = in_room.ways_of(settings, shell, vectors, pressure)
    first = arrivals(settings, rooms.machine_middle_m(settings, shell))
    diffuse = DiffuseRoom.of(rooms.room_of(settings))
    reach_m = float(np.hypot(shell.radius_m, shell.floor_clearance_m + shell.height_m))

    def direct_per_power(frequency_hz: Array) -> Array:
        return np.asarray(both.gain(frequency_hz) * first.per_power[:, None])

    def decay_s(frequency_hz: Array) -> Array:
        return np.asarray(diffuse.reverberation_time_s(frequency_hz), dtype=np.float64)

    return WaysOfRoom(
        pressure=rooms.of_rigid(pressure),
        ways=both.ways,
        direct_per_power=direct_per_power,
        distance_m=np.asarray(first.distance_m, dtype=np.float64),
        nearest_m=both.ways.radius_m - reach_m,
        decay_s=decay_s,
        record_s=float(vectors.attrs["room_record_s"]),
        highest_hz=float(vectors["frequency"].values[-1]),
    )
