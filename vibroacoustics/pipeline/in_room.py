"""The machine of a study in its room: levels at the listeners, the seam of methods, a map."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.progress import Progress
from ..base.vocabulary import REFERENCE_OPTION, check, stamp
from ..levels.in_room import RoomSound, RoomWays, blended_gains, room_sound, wave_gains
from ..levels.measured_points import MIDDLE_HZ
from ..levels.room_levels import (
    AirInRoom,
    air_variables,
    drawn_band,
    line_variables,
    plate_variables,
)
from ..levels.room_map import map_bands_hz, map_level
from ..levels.room_rest import rest_in_bands
from ..levels.room_seam import seam_variables, shown_bands
from ..machine.shell import Shell
from ..machine.source import CaseKey
from ..radiation.patterns import SurfaceMotion
from ..radiation.rooms import of_study as rooms
from ..radiation.rooms import room_vectors
from ..radiation.rooms.plane import plane_gains
from ..results import storage
from ..sources.cases import sources_of
from ..study.room import StudyRoom
from ..study.study import Study
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from .motion import Motion


def sound_in_room(
    study: Study, motion: Motion, shell: ShellPath | None, progress: Progress
) -> xr.Dataset:
    """Sound of the machine in the room of the study; empty where it has none.

    Parameters
    ----------
    study : with its table of the room
    motion : of every speed with every option; its results hold the levels
    shell : its elastic modes; none where no source drives it
    progress : called with the advance
    """
    settings = study.room
    if settings is None:
        return xr.Dataset()
    vectors, _ = vectors_of(study, settings, () if shell is None else shell.modes, progress)
    pressure, listeners = rooms.pressure_at_places(vectors), list(settings.listeners)
    both_ways = ways_of(settings, study.machine.shell, vectors, pressure)
    received = _transmission(study, motion, shell, pressure).received(motion.cases, motion.loads)
    by_case = {key: room_sound(one, both_ways.ways) for key, one in received.items()}
    gains, _ = blended_gains(both_ways.waves, both_ways.ways)
    air = _by_air(study, motion, by_case, gains)
    sources = list(sources_of(study))
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    sound = air_variables(air, speeds, options, listeners, sources)
    sound = sound.merge(line_variables(by_case, motion.results.merge(sound)))
    results = motion.results.merge(sound)
    sound = sound.merge(drawn_band(air, results, study.catalogue_receiver))
    sound = sound.merge(_by_plate(settings, vectors, results.merge(sound)))
    of_seam = (both_ways.shown, *both_ways.both, both_ways.gains_db)
    sound = sound.merge(_of_the_room(settings)).merge(seam_variables(listeners, *of_seam))
    return sound.merge(_map(study, settings, air, progress))


class BothMethods(NamedTuple):
    """Ways to the listeners, and both methods around their seam.

    Attributes
    ----------
    ways : with the gain of the place
    gain : of the power at the machine's place, of frequencies
    waves : mean square per power, shape (listener, band), Pa²/W
    shown : numbers of the bands around the seam
    both : waves and diffuse field in these, without the gain
    gains_db : of the place, in these and above
    """

    ways: RoomWays
    gain: Callable[[Array], Array]
    waves: Array
    shown: IndexArray
    both: tuple[Array, Array]
    gains_db: Array


def ways_of(
    settings: StudyRoom, shell: Shell, vectors: xr.Dataset, pressure: rooms.PressureAt
) -> BothMethods:
    """How the machine's sound comes to the listeners.

    Parameters
    ----------
    settings : of the room
    shell : of the machine
    vectors, pressure : of `vectors_of` and `pressure_at_places`
    """
    highest_hz, at = settings.maximum_frequency_hz, rooms.machine_middle_m(settings, shell)
    share, radius_m = rooms.wave_share(highest_hz), float(vectors.attrs["hemisphere_radius_m"])
    count = len(settings.listeners)
    free = RoomWays(count, radius_m, share, rooms.diffuse_per_power(settings, at))
    waves = wave_gains(pressure, free, highest_hz)
    shown = shown_bands(rooms.seam_bands_hz(highest_hz))
    both = (waves[:, shown], blended_gains(waves, free)[1][:, shown])
    gains_db = rooms.place_gains_db(*both)
    gain = rooms.gain_over_frequency(gains_db, MIDDLE_HZ[shown])
    per_power = rooms.diffuse_per_power(settings, at, gain)
    return BothMethods(
        RoomWays(count, radius_m, share, per_power), gain, waves, shown, both, gains_db
    )


def vectors_of(
    study: Study, settings: StudyRoom, motions: Sequence[SurfaceMotion], progress: Progress
) -> tuple[xr.Dataset, bool]:
    """Pressure per velocity at the listeners and on the hemisphere; from the cache if there."""
    return storage.cached(
        "room-responses",
        rooms.room_key(study, settings, motions),
        lambda: room_vectors(
            study.machine.shell,
            study.radiation,
            rooms.room_of(settings),
            rooms.foot_m(settings),
            rooms.listeners_m(settings),
            settings.maximum_frequency_hz,
            motions,
            progress,
        ),
    )


def _transmission(
    study: Study, motion: Motion, shell: ShellPath | None, pressure: rooms.PressureAt
) -> Transmission:
    """The way of the sound to the listeners and to the positions on the hemisphere."""
    rigid = rooms.of_rigid(pressure)
    return Transmission(
        study,
        Observers(rigid, None if shell is None else rooms.of_modes(pressure)),
        shell,
        motion.wrenches,
    )


def _by_air(
    study: Study, motion: Motion, sound: Mapping[CaseKey, RoomSound], gains: Array
) -> AirInRoom:
    return AirInRoom.of(
        sound,
        list(study.operation.speed_rpm),
        list(study.options),
        rest_in_bands(motion.results, study.catalogue_receiver),
        gains,
        study.receivers[study.catalogue_receiver].distance_m,
    )


def _by_plate(settings: StudyRoom, vectors: xr.Dataset, results: xr.Dataset) -> xr.Dataset:
    if "structure_borne_power" not in results:
        return xr.Dataset()
    frequency = results["tone_frequency"].transpose("speed", "line").values
    hertz = np.where(np.nan_to_num(frequency) > 0.0, frequency, MIDDLE_HZ[0])
    per_power = rooms.plate_per_power(settings, vectors)
    return plate_variables(results, np.array([per_power(row) for row in hertz]))


def _of_the_room(settings: StudyRoom) -> xr.Dataset:
    """Its absorption, and what its listeners accept."""
    octaves, area = rooms.absorption_by_octave(settings)
    limits = settings.limits.levels
    arrays = {"room_absorption_area": stamp("room_absorption_area", area, {"room_octave": octaves})}
    if limits:
        coords = {"room_limit_time": list(limits)}
        arrays["room_limit"] = stamp("room_limit", list(limits.values()), coords)
    return check(xr.Dataset(arrays))


def _map(study: Study, settings: StudyRoom, air: AirInRoom, progress: Progress) -> xr.Dataset:
    """Level over the plane of the first listener's ears, of the machine without an option."""
    height_m = next(iter(settings.listeners.values())).height_m
    at = rooms.machine_middle_m(settings, study.machine.shell)
    above_m, bands = float(at[2] - settings.standing_height_m), map_bands_hz()
    gains, _ = storage.cached(
        "room-plane",
        {**rooms.room_key(study, settings, ()), "plane": [height_m, *map(list, bands.values())]},
        lambda: plane_gains(
            rooms.room_of(settings), at, above_m, height_m, bands, settings.maximum_frequency_hz,
            progress,
        ),
    )  # fmt: skip
    speeds = np.array(study.operation.speed_rpm)
    speed = int(np.argmin(np.abs(speeds - study.catalogue_speed_rpm)))
    power = air.power_band[speed, list(study.options).index(REFERENCE_OPTION)]
    return map_level(gains["room_map_gain"], power, float(speeds[speed]), height_m)
