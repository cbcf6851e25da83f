"""Statement of tones: those that are prominent at any microphone (ECMA-418-1)."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...sound.ingredients import ingredients
from ...sound.of_results import excess_db
from ...sound.tonality import Tone as JudgedTone
from ...sound.tonality import tonal_spectrum, tones
from .model import Tone


def prominent_tones(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> tuple[tuple[Tone, ...], int]:
    """Each prominent tone once, at the microphone at which it is furthest above its criterion.

    A tone is judged where its critical band holds noise: unmodelled noise or that of a source.
    Otherwise any tone would be prominent.

    Parameters
    ----------
    results : of a run
    option, speed_rpm : of the sheet
    microphones : at which tones are judged

    Returns
    -------
    prominent tones, rising in frequency; number of audible tones that no microphone judges
    """
    most: dict[str, tuple[float, Tone]] = {}
    without_noise, judged = set[str](), set[str]()
    for name in microphones:
        spectrum = tonal_spectrum(ingredients(results, option, name, speed_rpm))
        for tone in tones(spectrum):
            if not np.isfinite(tone.noise_ratio_db):
                without_noise |= {tone.name} if tone.audible else set()
                continue
            judged.add(tone.name)
            excess = excess_db(tone)
            if tone.prominent and (tone.name not in most or excess > most[tone.name][0]):
                most[tone.name] = excess, _stated(tone, name)
    stated = sorted((tone for _, tone in most.values()), key=lambda tone: tone.frequency_hz)
    return tuple(stated), len(without_noise - judged)


def _stated(tone: JudgedTone, microphone: str) -> Tone:
    return Tone(
        name=tone.name,
        frequency_hz=tone.frequency_hz,
        microphone=microphone,
        level_db=tone.level_db,
        tone_to_noise_db=tone.noise_ratio_db,
        prominence_db=tone.prominence_db if np.isfinite(tone.prominence_db) else None,
    )
