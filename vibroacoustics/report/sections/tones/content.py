"""Tones, loudness and sharpness of every option."""

import xarray as xr

from ....base.registry import register
from ....results.estimates import is_sampled
from ...blocks import Block, Text
from .. import Section, hold
from .tables import NO_LOUDNESS, tone_data, tone_table

_HOW = (
    "A tone is listed if it is audible and prominent (ECMA-418-1){samples}. The excess is the "
    "larger one over the criteria of tone-to-noise and prominence ratio. The noise is that of the "
    "sources and the unmodelled noise. {loudness} Other speeds and microphones are in tones.csv."
)
_LOUDNESS = "Loudness: ISO 532-1 (sone); sharpness: DIN 45692 (acum)."


def _blocks(results: xr.Dataset) -> list[Block]:
    samples = " in more than half of the samples" if is_sampled(results, "tone_excess") else ""
    loudness = _LOUDNESS if "loudness" in results else NO_LOUDNESS
    return [tone_table(results), Text(_HOW.format(samples=samples, loudness=loudness), "note")]


_applies = hold("pressure_line", "noise_band_level", "tone_excess")
register(Section("tones", "Tones and loudness", _blocks, _applies, 38.0, tables=tone_data))
