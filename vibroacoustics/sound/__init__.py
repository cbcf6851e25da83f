"""Sound to listen to, and what an ear makes of it: tones, loudness, sharpness.

>>> results = va.open_results("results.nc")
>>> parts = va.sound.ingredients(results, "none", "front_1m", 2900.0)
>>> pressure_pa = va.sound.rendered(parts, va.sound.whole_revolutions(2.0, 2900.0, 48000))
>>> strongest = va.sound.tones(va.sound.tonal_spectrum(parts))[0]
"""

from .ingredients import Ingredients, SoundBands, SoundLines, ingredients
from .loudness import Loudness, loudness_of, recorded_loudness
from .recorded import NarrowBands, narrow_bands, recorded_spectrum
from .rendering import rendered, whole_revolutions
from .tonality import TonalSpectrum, Tone, prominent, tonal_spectrum, tones

__all__ = [
    "Ingredients",
    "Loudness",
    "NarrowBands",
    "SoundBands",
    "SoundLines",
    "TonalSpectrum",
    "Tone",
    "ingredients",
    "loudness_of",
    "narrow_bands",
    "prominent",
    "recorded_loudness",
    "recorded_spectrum",
    "rendered",
    "tonal_spectrum",
    "tones",
    "whole_revolutions",
]
