"""From the motion of the housing to the sound at the microphones."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Heading, Pictures, Text
from ...figures.deflection import deflection_picture
from ...figures.directivity import polar_levels
from ...figures.maps import line_map
from ...figures.radiation import green_difference, levels, transfer
from ...kwave_words import kwave_sentence, kwave_to_hz
from ...shown_speeds import chosen_speeds, few_speeds
from .. import Section
from .tables import (
    grid_error_sentence,
    line_difference_sentence,
    receivers_table,
    sound_power_table,
)

_SENTENCES = (kwave_sentence, line_difference_sentence, grid_error_sentence)


def _blocks(results: xr.Dataset) -> list[Block]:
    power = sound_power_table(few_speeds(results))
    difference = [green_difference(results)] if kwave_to_hz(results) else []
    shapes = [deflection_picture(results)] if "deflection" in results else []
    around = [polar_levels(results)] if "polar_level" in results else []
    maps = [line_map(results)] if "map_level" in results else []
    return [
        Text(" ".join(filter(None, (part(results) for part in _SENTENCES)))),
        receivers_table(results),
        *chosen_speeds(results, "comparison.csv"),
        *([power] if power else []),
        Pictures((levels(results), *difference)),
        Heading("From velocity of the housing to sound pressure"),
        Pictures((*shapes, *around, *maps, transfer(results))),
    ]


register(Section("radiation", "Radiation and levels", _blocks, position=70.0))
