"""Statement of tones: those that are prominent at any microphone (ECMA-418-1)."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...sound.ingredients import ingredients
from ...sound.of_results import excess_db
from ...sound.tonality import Tone as JudgedTone
from ...sound.tonality import prominent, tonal_spectrum, tones
from .model import Tone


def prominent_tones(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> tuple[Tone, ...]:
    """Each prominent tone once, at the microphone at which it is furthest above its criterion.

    Parameters
    ----------
    results : of a run
    option, speed_rpm : of the sheet
    microphones : at which tones are judged
    """
    most: dict[str, tuple[float, Tone]] = {}
    for name in microphones:
        spectrum = tonal_spectrum(ingredients(results, option, name, speed_rpm))
        for tone in prominent(tones(spectrum)):
            excess = excess_db(tone)
            if tone.name not in most or excess > most[tone.name][0]:
                most[tone.name] = excess, _stated(tone, name)
    return tuple(sorted((tone for _, tone in most.values()), key=lambda tone: tone.frequency_hz))


def _stated(tone: JudgedTone, microphone: str) -> Tone:
    return Tone(
        name=tone.name,
        frequency_hz=tone.frequency_hz,
        microphone=microphone,
        level_db=tone.level_db,
        tone_to_noise_db=_finite(tone.noise_ratio_db),
        prominence_db=_finite(tone.prominence_db),
    )


def _finite(ratio: float) -> float | None:
    return ratio if np.isfinite(ratio) else None
