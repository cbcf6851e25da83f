"""Claims on recorded sound: loudness, sharpness and tonal adjustment of a channel."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base import rounding
from ..results.claim_kinds import ADJUSTMENT, LOUDNESS, SHARPNESS
from ..results.conditional import ConditionalClaim, Finding
from ..sound.audibility import tonal_adjustment_db
from ..sound.audible_tones import HIGHEST_HZ
from ..sound.loudness import QUIET_SONE, Loudness
from ..sound.mean_audibility import MeanAudibility
from ..sound.zwicker import LOUDEST_DB

VARIES_DB: Final = 4.0
"""Range of the levels of a sound that varies. Assumed, 3 to 6 dB: of broadband noise the blocks are
within 2 dB. Loudness of the 25 such sounds of ISO 532-1 is 4 to 41 % below their N5."""
_SPECTRA: Final = 12
"""Spectra of 3 s from which on the mean audibility is reliable (ISO/PAS 20065)."""


@dataclass(frozen=True)
class ChannelSound:
    """Findings on a channel.

    Attributes
    ----------
    channel : name
    loudness : not a number of a channel that is too loud
    mean : audibility of its tones
    variation_db : range of its level over time
    drift_octaves : by which its lines rise or fall
    rate_hz : sample rate
    """

    channel: str
    loudness: Loudness
    mean: MeanAudibility
    variation_db: float
    drift_octaves: float
    rate_hz: float


def claims_of_channel(sound: ChannelSound) -> Iterator[ConditionalClaim]:
    """Give loudness, sharpness and tonal adjustment with their conditions."""
    loud = sound.loudness
    is_audible = not loud.loudness_sone < QUIET_SONE
    is_too_loud = bool(np.isnan(loud.loudness_sone))
    loudest = f"{'above' if is_too_loud else 'at most'} {LOUDEST_DB:g} dB"
    shared = {
        "bands": Finding(f"{loud.highest_band_hz / 1000.0:g} kHz", not loud.is_lower_bound),
        "third octaves below 300 Hz": Finding(loudest, not is_too_loud),
        "steady level": Finding(f"{sound.variation_db:.0f} dB", sound.variation_db < VARIES_DB),
    }
    yield LOUDNESS.claim(f"{rounding.three_digits(loud.loudness_sone)} sone", shared, sound.channel)
    is_bounded = is_too_loud or not is_audible or not np.isnan(loud.sharpness_acum)
    sharp = {
        **shared,
        "sound below the missing bands": Finding(
            "loud enough" if is_bounded else "too weak", is_bounded
        ),
        "audible sound": Finding(rounding.three_digits(loud.loudness_sone), is_audible),
    }
    yield SHARPNESS.claim(f"{rounding.fixed(loud.sharpness_acum, 2)} acum", sharp, sound.channel)
    highest_hz, spectra = 0.5 * sound.rate_hz, len(sound.mean.decisive)
    direction = "rise" if sound.drift_octaves > 0.0 else "fall"
    octaves = abs(sound.drift_octaves)
    of_lines = f"{direction} by {octaves:.1g} octaves" if octaves else "are constant"
    judged = {
        "range": Finding(f"{highest_hz / 1000.0:g} kHz", highest_hz >= HIGHEST_HZ),
        "spectra": Finding(str(spectra), spectra >= _SPECTRA),
        "steady lines": Finding(of_lines, not octaves),
    }
    adjustment = tonal_adjustment_db(np.array(sound.mean.audibility_db)).item()
    yield ADJUSTMENT.claim(f"{adjustment:g} dB", judged, sound.channel)
