"""Tones, loudness and sharpness of every option."""

import xarray as xr

from ...base.registry import register
from ...sound.loudness import NEEDED, available
from ..blocks import Block, Text
from ..speeds import chosen_speeds
from ..tones import has_sound, tone_tables
from . import Section

_HOW = (
    "A tone is prominent (ECMA-418-1) where it stands over the noise of its critical band, or its "
    "band over the two beside it, by more than the figure in brackets. Noise is that of the "
    "sources and what the model does not explain, whose spectrum is assumed where no baseline was "
    "measured."
)
_LOUDNESS = "Loudness in sone by ISO 532-1 (Zwicker, free field), sharpness in acum by DIN 45692."


def _blocks(results: xr.Dataset) -> list[Block]:
    loudness = _LOUDNESS if available() else f"{NEEDED[0].upper()}{NEEDED[1:]}."
    return [
        *chosen_speeds(results, "results.nc"),
        *tone_tables(results),
        Text(f"{_HOW} {loudness}", "note"),
    ]


register(Section("tones", "Tones and loudness", _blocks, has_sound, 38.0))
