"""From the motion of the housing to the sound at the microphones."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Heading, Pictures, Text
from ..figures import level_figures, line_map_figures, transfer_figures
from ..housing import green_sentence, grid_error_sentence, receivers_table, sound_power_table
from ..speeds import chosen_speeds
from ..study import few_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    power = sound_power_table(few_speeds(results))
    transfer, *difference = transfer_figures(results)
    return [
        Text(f"{green_sentence(results)} {grid_error_sentence(results)}"),
        receivers_table(results),
        *chosen_speeds(results, "comparison.csv"),
        *([power] if power else []),
        Pictures((*level_figures(results), *difference)),
        Heading("From velocity of the housing to sound pressure"),
        Pictures((*line_map_figures(results), transfer)),
    ]


register(Section("radiation", "Radiation and levels", _blocks, position=70.0))
