"""The machine of a study in its room: levels at the listeners, both methods, a map."""

from collections.abc import Sequence
from typing import Final

import xarray as xr

from ..base.progress import Progress
from ..base.registry import register
from ..levels.in_room import blended_gains, room_sound
from ..levels.nominal import NominalSound
from ..levels.room_crossover import crossover_variables, map_bands_hz, map_level
from ..levels.room_levels import AirInRoom, room_variables
from ..machine.cases import Cases
from ..radiation.patterns import SurfaceMotion
from ..radiation.rooms import of_study as rooms
from ..radiation.rooms.cost import room_cost
from ..radiation.rooms.impedance import warn_of_absorption
from ..results import storage
from ..results.estimates import nominal_values
from ..sound.room_paths import paths_of
from ..study.room import StudyRoom
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..uncertainty.sampled_room import sampled_room_level
from .chain import Chain
from .radiation import modes_of
from .stage import Given, Stage, Trial

_CACHE: Final = "room-responses"


@register
class SoundInRoom(Stage):
    """Sound of the machine at the listeners in the room of the study."""

    name = "room"
    reads = (
        Cases, ShellPath, NominalSound, "velocity_order", "level_total*", "level_modelled*",
        "pressure_line*", "noise_band_level*", "unmodelled_band_level*", "baseline_band_level",
        "sample_weight", "structure_borne_*",
    )  # fmt: skip
    gives = ("room_*",)

    def applies(self, study: Study) -> bool:
        return study.room is not None

    def run(self, chain: Chain) -> Given:
        settings = chain.study.room
        return Given() if settings is None else Given(_sound_in_room(chain, settings))

    def tried(self, chain: Chain, study: Study) -> Trial:
        settings = study.room
        if settings is None or storage.is_cached(
            _CACHE, rooms.room_key(study, settings, modes_of(chain))
        ):
            return Trial(chain)
        return Trial(chain, (room_cost(study, settings),))


def vectors_of(
    study: Study, settings: StudyRoom, motions: Sequence[SurfaceMotion], progress: Progress
) -> tuple[xr.Dataset, bool]:
    """Pressure per velocity at the listeners and on the hemisphere; from the cache if there."""
    warn_of_absorption(rooms.room_of(settings), settings.maximum_frequency_hz)
    return storage.cached(
        _CACHE,
        rooms.room_key(study, settings, motions),
        lambda: rooms.vectors_in_room(study, settings, motions, progress),
        study.title,
    )


def _sound_in_room(chain: Chain, settings: StudyRoom) -> xr.Dataset:
    study, results, shell = chain.study, nominal_values(chain.results), chain.get(ShellPath)
    vectors, _ = vectors_of(study, settings, modes_of(chain), chain.progress)
    pressure, listeners = rooms.pressure_at_positions(vectors), list(settings.listeners)
    modes = None if shell is None else rooms.of_modes(pressure)
    paths = Transmission(study, Observers(rooms.of_rigid(pressure), modes), shell)
    room_paths = paths_of(settings, study.machine.shell, vectors, pressure)
    received = paths.received(chain[Cases]).items()
    sound = {key: room_sound(of_case, room_paths.paths) for key, of_case in received}
    gains, _ = blended_gains(room_paths.waves, room_paths.paths)
    air = AirInRoom.of(chain[NominalSound], listeners, sound, results, gains)
    per_power = rooms.plate_per_power(settings, vectors)
    statistics = sampled_room_level(air, results, study.catalogue_receiver)
    levels = room_variables(air, sound, results, statistics, per_power)
    levels = levels.merge(rooms.surface_variables(settings))
    transfers, gains_db = room_paths.transfers, room_paths.gains_db
    levels = levels.merge(crossover_variables(listeners, room_paths.shown, *transfers, gains_db))
    return levels.merge(_map(study, settings, air, chain.progress))


def _map(study: Study, settings: StudyRoom, air: AirInRoom, progress: Progress) -> xr.Dataset:
    """Level over the plane of the first listener's ears, of the machine without an option."""
    bands = map_bands_hz()
    gains, _ = storage.cached(
        "room-plane",
        rooms.plane_key(study, settings, bands),
        lambda: rooms.plane_in_room(study, settings, bands, progress),
        study.title,
    )
    height_m = rooms.map_height_m(settings)
    return map_level(study, gains["room_map_gain"], air.power_band, height_m)
