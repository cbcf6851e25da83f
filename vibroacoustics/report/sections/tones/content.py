"""Tones, loudness and sharpness of every option."""

import xarray as xr

from ....base.registry import register
from ....results.estimates import is_sampled
from ...blocks import Block, Text
from ...shown_speeds import chosen_speeds
from .. import Section
from .tables import NO_LOUDNESS, has_sound, tone_tables

_HOW = (
    "A tone is listed if it is above the threshold of hearing and prominent (ECMA-418-1) in more "
    "than half of the weighted samples. The excess is the larger one over the criteria of "
    "tone-to-noise and prominence ratio. Noise is that of the sources and the unmodelled noise of "
    "the same sample; its spectrum is assumed where no baseline was measured. The last probability "
    "is that of some prominent tone, not always the same."
)
_NOMINAL = (
    "A tone is listed if it is above the threshold of hearing and prominent (ECMA-418-1). The "
    "excess is the larger one over the criteria of tone-to-noise and prominence ratio. Noise is "
    "that of the sources and the unmodelled noise, whose spectrum is assumed where no baseline was "
    "measured. A tone without noise in its critical band is not judged."
)
_LOUDNESS = "Loudness in sone by ISO 532-1 (Zwicker, free field), sharpness in acum by DIN 45692."


def _blocks(results: xr.Dataset) -> list[Block]:
    loudness = _LOUDNESS if "loudness" in results else NO_LOUDNESS
    return [
        *chosen_speeds(results, "results.nc"),
        *tone_tables(results),
        Text(f"{_HOW if is_sampled(results, 'tone_excess') else _NOMINAL} {loudness}", "note"),
    ]


register(Section("tones", "Tones and loudness", _blocks, has_sound, 38.0))
