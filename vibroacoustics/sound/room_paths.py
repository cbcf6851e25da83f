"""Paths from a machine to the listeners in its room: waves below, a diffuse field above."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.vocabulary import RIGID_BODY_DOFS, stamped
from ..levels.in_room import RoomPaths, blended_gains, wave_gains
from ..levels.measured_points import MIDDLE_HZ
from ..levels.room_crossover import shown_bands
from ..machine.shell import Shell
from ..radiation.rooms import DiffuseRoom
from ..radiation.rooms import of_study as rooms
from ..radiation.rooms.of_study import arrivals
from ..study.room import StudyRoom
from .rendering import SAMPLE_RATE_HZ
from .room_responses import PathsOfRoom, room_responses


class BothMethods(NamedTuple):
    """Paths to the listeners, and both methods around their crossover.

    Attributes
    ----------
    paths : with the gain of the place
    gain : gain of the power at the machine's position, a function of frequencies
    waves : mean square per power, shape (listener, band), Pa²/W
    shown : numbers of the bands around the crossover, shape (shown band,)
    transfers : waves and diffuse field in these, without the gain
    gains_db : gains of the position in these bands and above, shape (shown band + 1,)
    """

    paths: RoomPaths
    gain: Callable[[Array], Array]
    waves: Array
    shown: IndexArray
    transfers: tuple[Array, Array]
    gains_db: Array


def paths_of(
    settings: StudyRoom, shell: Shell, vectors: xr.Dataset, pressure: rooms.PressureAt
) -> BothMethods:
    """Compute the paths from the machine to the listeners by both methods.

    Parameters
    ----------
    settings : settings of the room
    shell : shell of the machine
    vectors, pressure : results of `vectors_of` and `pressure_at_positions`
    """
    highest_hz, middle_m = settings.maximum_frequency_hz, rooms.machine_middle_m(settings, shell)
    share, radius_m = rooms.wave_share(highest_hz), float(vectors.attrs["hemisphere_radius_m"])
    count = len(settings.listeners)
    free = RoomPaths(count, radius_m, share, rooms.diffuse_per_power(settings, middle_m))
    waves = wave_gains(pressure, free, highest_hz)
    shown = shown_bands(rooms.crossover_bands_hz(highest_hz))
    transfers = (waves[:, shown], blended_gains(waves, free)[1][:, shown])
    gains_db = rooms.position_gains_db(*transfers)
    gain = rooms.gain_over_frequency(gains_db, MIDDLE_HZ[shown])
    per_power = rooms.diffuse_per_power(settings, middle_m, gain)
    return BothMethods(
        RoomPaths(count, radius_m, share, per_power), gain, waves, shown, transfers, gains_db
    )


def response_paths(settings: StudyRoom, shell: Shell, vectors: xr.Dataset) -> PathsOfRoom:
    """Return the paths of the rigid motions to the listeners, as impulse responses need them.

    Parameters
    ----------
    settings : room
    shell : housing of the machine
    vectors : pressure per velocity at the listeners and on the hemisphere
    """
    pressure = rooms.pressure_at_positions(vectors)
    of_study = paths_of(settings, shell, vectors, pressure)
    first = arrivals(settings, rooms.machine_middle_m(settings, shell))
    diffuse = DiffuseRoom.of(rooms.room_of(settings))
    profile = shell.profile
    reach_m = float(np.hypot(profile.radius_m, profile.top_z_m - shell.floor_z_m))

    def direct_per_power(frequency_hz: Array) -> Array:
        return np.asarray(of_study.gain(frequency_hz) * first.per_power[:, None])

    def decay_s(frequency_hz: Array) -> Array:
        return np.asarray(diffuse.reverberation_time_s(frequency_hz), dtype=np.float64)

    return PathsOfRoom(
        pressure=rooms.of_rigid(pressure),
        paths=of_study.paths,
        direct_per_power=direct_per_power,
        distance_m=np.asarray(first.distance_m, dtype=np.float64),
        nearest_m=of_study.paths.radius_m - reach_m,
        decay_s=decay_s,
        record_s=float(vectors.attrs["room_record_s"]),
        highest_hz=float(vectors["frequency"].values[-1]),
    )


def labelled_responses(settings: StudyRoom, shell: Shell, vectors: xr.Dataset) -> xr.DataArray:
    """Compute impulse responses to the listeners, `room_impulse_response` (listener, dof, time).

    Parameters
    ----------
    settings, shell, vectors : see `response_paths`
    """
    responses = room_responses(response_paths(settings, shell, vectors))
    coords = {
        "listener": list(settings.listeners),
        "dof": list(RIGID_BODY_DOFS),
        "time": np.arange(responses.shape[-1]) / SAMPLE_RATE_HZ,
    }
    return stamped({"room_impulse_response": responses}, coords)["room_impulse_response"]
