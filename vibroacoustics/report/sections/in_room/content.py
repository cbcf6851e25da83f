"""In the room: how loud the machine is at listeners between walls and furniture."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Details, Pictures, Text
from ...figures.in_room import room_map, room_seam
from ...tables import DataTable, long_table
from .. import Section
from .tables import (
    absorption,
    has_room,
    loudest_listener,
    loudness_words,
    power_sentence,
    room_sentence,
    room_table,
    seam_sentence,
    seam_table,
)

_LEVELS = ("room_level", "room_plate_level", "room_loudness", "room_sharpness")


def _blocks(results: xr.Dataset) -> list[Block]:
    loudest = loudest_listener(results)
    return [
        Text(room_sentence(results), "strong"),
        room_table(results, loudest),
        Text(power_sentence(results)),
        Text(seam_sentence(results)),
        Pictures((room_map(results), room_seam(results, loudest))),
        Details("Both methods at every listener", (seam_table(results),)),
        *(Details("Absorption of walls and furniture", (table,)) for table in absorption(results)),
        Text(
            "Below the crossover frequency sound is a wave field, above it direct sound and the "
            "diffuse field of the sound power. Unmodelled noise is radiated equally in all "
            "directions from the machine's axis; the plate by its mean power beside a foot "
            "(assumed). Intervals are those at the published microphone. "
            f"{loudness_words(results)} Other listeners and speeds are in room.csv.",
            "note",
        ),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = [name for name in map(str, results.data_vars) if name.startswith(_LEVELS)]
    return {"room.csv": long_table(results, names)}


register(Section("in-room", "In the room", _blocks, has_room, 33.5, tables=_data))
