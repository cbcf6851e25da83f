"""In the room: how loud the machine is at listeners between walls and furniture."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Details, Pictures, Text
from ...figures.in_room import room_map, room_seam
from .. import Section
from .tables import (
    absorption,
    has_room,
    listeners,
    loudest_listener,
    loudness_words,
    power_sentence,
    room_sentence,
    room_table,
    seam_sentence,
    seam_table,
)


def _blocks(results: xr.Dataset) -> list[Block]:
    loudest = loudest_listener(results)
    others = [name for name in listeners(results) if name != loudest]
    return [
        Text(room_sentence(results), "strong"),
        room_table(results, loudest),
        *(Details(f"At {name}", (room_table(results, name),)) for name in others),
        Text(power_sentence(results)),
        Text(seam_sentence(results)),
        Pictures((room_map(results), room_seam(results, loudest))),
        Details("Both methods at every listener", (seam_table(results),)),
        *(Details("Absorption of walls and furniture", (table,)) for table in absorption(results)),
        Text(
            "Waves to the seam, above it direct sound and the diffuse field of the power that the "
            "machine sends out on a hard floor in the open. What no source explains is taken as "
            "sent alike everywhere from the machine's axis, and to come to the listeners as the "
            "sound of a machine that shakes along x, y and z with equal powers. The sound of the "
            "plate is that of its mean power, sent out beside the machine's foot (assumed); where "
            "modes of the room cancel, one listener has 20 dB and more less of it than another. "
            "Bands of the samples are those at the published microphone, of the model and of what "
            "it does not explain each. "
            f"{loudness_words(results)}",
            "note",
        ),
    ]


register(Section("in-room", "In the room", _blocks, has_room, 33.5))
