"""Sound to listen to, and what an ear makes of it: tones, loudness, sharpness.

>>> results = va.open_results("results.nc")
>>> parts = va.sound.ingredients(results, "none", "front_1m", 2900.0)
>>> pressure_pa = va.sound.rendered(parts, va.sound.whole_revolutions(4.0, 2900.0, 48000))
>>> bands = va.sound.narrow_bands(pressure_pa, 48000)
>>> tones = va.sound.tones(va.sound.recorded_spectrum(bands))
"""

from .ingredients import Ingredients, SoundBands, SoundLines, ingredients
from .loudness import Loudness, loudness_of, recorded_loudness
from .recorded import NarrowBands, narrow_bands, recorded_spectrum
from .rendering import rendered, whole_revolutions
from .tonality import TonalSpectrum, Tone, prominent, tones

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
    "tones",
    "whole_revolutions",
]
