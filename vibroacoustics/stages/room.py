"""The machine of a study in its room: levels at the listeners, both methods, a map."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.progress import Progress
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION, check, stamp
from ..levels.in_room import RoomSound, blended_gains, room_sound
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
from ..levels.room_seam import seam_variables
from ..machine.source import CaseKey
from ..radiation.patterns import SurfaceMotion
from ..radiation.rooms import of_study as rooms
from ..radiation.rooms import room_vectors
from ..radiation.rooms.cost import room_cost
from ..radiation.rooms.plane import plane_gains
from ..radiation.rooms.wall_absorption import wall_absorption, warn_of_absorption
from ..results import storage
from ..results.storage import is_cached
from ..sound.room_ways import ways_of
from ..sources.cases import sources_of
from ..study.room import StudyRoom
from ..study.study import Study
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from .chain import Cases, Chain
from .stage import Given, Stage, Trial

_CACHE: Final = "room-responses"


@register
class SoundInRoom(Stage):
    """Sound of the machine at the listeners in the room of the study."""

    name = "room"
    reads = (
        Cases, ShellPath, "velocity_order", "level_total", "pressure_line", "noise_band_level",
        "remainder_band_level", "baseline_band_level", "draw_weight", "level_modelled",
        "level_total_by_draw", "level_modelled_by_draw", "structure_borne_power",
        "structure_borne_level", "structure_borne_level_low", "structure_borne_level_high",
    )  # fmt: skip
    gives = (
        "room_absorption_area", "room_wall_absorption", "room_wall_absorption_requested",
        "room_limit", "room_level", "room_level_low", "room_level_middle", "room_level_high",
        "room_level_both_ways", "room_source_level", "room_band_level", "room_noise_band_level",
        "room_pressure_line", "room_sound_power_level", "room_plate_level",
        "room_plate_level_low", "room_plate_level_high", "room_plate_line_level",
        "room_gain_waves", "room_gain_diffuse", "room_gain_difference", "room_place_gain",
        "room_place_gain_above", "room_map_level", "room_map_gain",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return study.room is not None

    def run(self, chain: Chain) -> Given:
        settings = chain.study.room
        return Given() if settings is None else Given(_sound_in_room(chain, settings))

    def tried(self, chain: Chain, study: Study) -> Trial:
        settings, path = study.room, chain.get(ShellPath)
        modes = () if path is None else path.modes
        if settings is None or is_cached(_CACHE, rooms.room_key(study, settings, modes)):
            return Trial(chain)
        return Trial(chain, (room_cost(study, settings),))


def _sound_in_room(chain: Chain, settings: StudyRoom) -> xr.Dataset:
    study, of, shell = chain.study, chain[Cases], chain.get(ShellPath)
    motions = () if shell is None else shell.modes
    vectors, _ = vectors_of(study, settings, motions, chain.progress)
    pressure, listeners = rooms.pressure_at_places(vectors), list(settings.listeners)
    both_ways = ways_of(settings, study.machine.shell, vectors, pressure)
    received = _transmission(chain, pressure).received(of.cases, of.loads)
    by_case = {key: room_sound(one, both_ways.ways) for key, one in received.items()}
    gains, _ = blended_gains(both_ways.waves, both_ways.ways)
    air = _by_air(study, chain.results, by_case, gains)
    sources = list(sources_of(study))
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    sound = air_variables(air, speeds, options, listeners, sources)
    sound = sound.merge(line_variables(by_case, chain.results.merge(sound)))
    results = chain.results.merge(sound)
    sound = sound.merge(drawn_band(air, results, study.catalogue_receiver))
    sound = sound.merge(_by_plate(settings, vectors, results.merge(sound)))
    of_seam = (both_ways.shown, *both_ways.both, both_ways.gains_db)
    sound = sound.merge(_of_the_room(settings)).merge(seam_variables(listeners, *of_seam))
    return sound.merge(_map(study, settings, air, chain.progress))


def vectors_of(
    study: Study, settings: StudyRoom, motions: Sequence[SurfaceMotion], progress: Progress
) -> tuple[xr.Dataset, bool]:
    """Pressure per velocity at the listeners and on the hemisphere; from the cache if there."""
    warn_of_absorption(rooms.room_of(settings), settings.maximum_frequency_hz)
    return storage.cached(
        _CACHE,
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


def _transmission(chain: Chain, pressure: rooms.PressureAt) -> Transmission:
    """Paths of the sound to the listeners and to the positions on the hemisphere."""
    study, shell, rigid = chain.study, chain.get(ShellPath), rooms.of_rigid(pressure)
    return Transmission(
        study,
        Observers(rigid, None if shell is None else rooms.of_modes(pressure)),
        shell,
        chain[Cases].wrenches,
    )


def _by_air(
    study: Study, results: xr.Dataset, sound: Mapping[CaseKey, RoomSound], gains: Array
) -> AirInRoom:
    return AirInRoom.of(
        sound,
        list(study.operation.speed_rpm),
        list(study.options),
        rest_in_bands(results, study.catalogue_receiver),
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
    """Its absorption, that of its surfaces, and what its listeners accept."""
    surfaces = wall_absorption(rooms.room_of(settings), settings.maximum_frequency_hz)
    octaves, area = rooms.absorption_by_octave(settings)
    limits = settings.limits.levels
    arrays = {"room_absorption_area": stamp("room_absorption_area", area, {"room_octave": octaves})}
    if limits:
        coords = {"room_limit_time": list(limits)}
        arrays["room_limit"] = stamp("room_limit", list(limits.values()), coords)
    return check(xr.Dataset(arrays).merge(surfaces))


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
