"""Prominent tones of a data sheet, each at one microphone (ECMA-418-1)."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.decibel import NO_TONE_DB
from ..levels.hearing import hearing_threshold_db
from ..results.data_sheet import Tone
from ..results.prominent_tones import ProminentTone, listed_tones


def prominent_tones(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> tuple[Tone, ...]:
    """Return each prominent tone once, at the microphone with its largest excess.


    Returns
    -------
    tones, rising in frequency
    """
    largest: dict[str, ProminentTone] = {}
    for microphone in microphones:
        for tone in listed_tones(results, option, microphone, speed_rpm):
            before = largest.get(tone.name)
            if before is None or tone.excess_db.value > before.excess_db.value:
                largest[tone.name] = tone
    rising = sorted(largest.values(), key=lambda tone: tone.frequency_hz)
    return tuple(map(_stated, rising))


def not_judged(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> int:
    """Return the number of audible tones that are judged at no microphone.

    A tone is not judged where there is no noise in its critical band.
    """
    case = results.sel(option=option, speed=speed_rpm, receiver=list(microphones))
    hertz = case["judged_tone_frequency"].values
    has_frequency = np.isfinite(hertz)
    threshold = np.array([hearing_threshold_db(value) for value in hertz[has_frequency].tolist()])
    level, excess = (
        case[name].transpose("receiver", "judged_tone").values[:, has_frequency]
        for name in ("tone_level", "tone_excess")
    )
    without = (level >= threshold) & (excess <= NO_TONE_DB)
    return int((without.any(axis=0) & (excess <= NO_TONE_DB).all(axis=0)).sum())


def _stated(tone: ProminentTone) -> Tone:
    low = tone.excess_db.low
    return Tone(
        name=tone.name,
        frequency_hz=tone.frequency_hz,
        microphone=tone.microphone,
        level_db=tone.level_db,
        excess_db=tone.excess_db.value,
        excess_low_db=low if low > NO_TONE_DB else None,
        excess_high_db=tone.excess_db.high,
        probability=tone.probability,
    )
