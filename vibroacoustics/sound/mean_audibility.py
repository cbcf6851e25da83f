"""Audibility of the tones of a sound over time (ISO/PAS 20065)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import energy_mean, mean_square_level
from ..base.errors import ParameterError
from ..base.weighting import a_weighting
from .audibility import NO_TONE_AUDIBILITY_DB, critical_edges_hz, mean_uncertainty_db
from .audible_tones import HIGHEST_HZ, STEP_HZ, AudibleTone, audible_tones

SPECTRUM_S: Final = 3.0
"""Time over which one spectrum is averaged (ISO/PAS 20065, clause 5.3.2)."""


@dataclass(frozen=True)
class MeanAudibility:
    """Audibility of the tones of a sound, over its spectra.

    Attributes
    ----------
    audibility_db : energy mean of the decisive audibilities of the spectra
    uncertainty_db : its extended uncertainty, 90 % on both sides
    spectra_db : decisive audibility of each spectrum, -10 dB without a tone, shape (spectrum,)
    decisive : most audible tone or tones of each spectrum; None without one
    """

    audibility_db: float
    uncertainty_db: float
    spectra_db: Array
    decisive: tuple[AudibleTone | None, ...]


def mean_audibility(pressure_pa: Array, sample_rate_hz: float) -> MeanAudibility:
    """Find the audible tones of a sound in spectra of 3 s, and their mean audibility.

    A spectrum without an audible tone counts as -10 dB (equation 21).

    Parameters
    ----------
    pressure_pa : sound pressure, shape (sample,), Pa
    sample_rate_hz : number of samples a second, Hz
    """
    frequency_hz, level_db = narrow_band_levels(pressure_pa, sample_rate_hz)
    return mean_of_spectra(
        [decisive_tone(audible_tones(spectrum, frequency_hz)) for spectrum in level_db]
    )


def mean_of_spectra(decisive: Sequence[AudibleTone | None]) -> MeanAudibility:
    """Average the decisive audibilities of spectra (equations 20, 21 and 28).

    Parameters
    ----------
    decisive : most audible tone of each spectrum, or None
    """
    uncertainty_db = np.array([tone.uncertainty_db if tone else 0.0 for tone in decisive])
    spectra_db = np.array(
        [tone.audibility_db if tone else NO_TONE_AUDIBILITY_DB for tone in decisive]
    )
    return MeanAudibility(
        float(energy_mean(spectra_db)),
        mean_uncertainty_db(spectra_db, uncertainty_db),
        spectra_db,
        tuple(decisive),
    )


def narrow_band_levels(pressure_pa: Array, sample_rate_hz: float) -> tuple[Array, Array]:
    """Return frequencies (line,), Hz, and A-weighted levels (spectrum, line), dB, of a sound.

    Each spectrum is the mean of Hann windows that overlap by half, over 3 s; the last ends with
    the sound. A line holds the mean square of a tone at its frequency.

    Parameters
    ----------
    pressure_pa : sound pressure, shape (sample,), Pa
    sample_rate_hz : number of samples a second, Hz

    Raises
    ------
    ParameterError
        The recording is shorter than 3 s.
    """
    each = round(SPECTRUM_S * sample_rate_hz)
    if pressure_pa.size < each:
        seconds = pressure_pa.size / sample_rate_hz
        raise ParameterError(
            f"recording of {seconds:.3g} s: audible tones need at least {SPECTRUM_S:g} s"
        )
    length = 2 * round(0.5 * sample_rate_hz / STEP_HZ)
    starts = np.linspace(0, pressure_pa.size - each, pressure_pa.size // each).round().astype(int)
    spectra = [
        scipy.signal.welch(
            pressure_pa[start : start + each], sample_rate_hz, "hann", length, scaling="spectrum"
        )[1]
        for start in starts
    ]
    frequency_hz = np.fft.rfftfreq(length, 1.0 / sample_rate_hz).astype(float)
    is_judged = (frequency_hz > 0.0) & (frequency_hz <= critical_edges_hz(np.array(HIGHEST_HZ))[1])
    level_db = mean_square_level(np.stack(spectra)[:, is_judged], REFERENCE_PRESSURE_PA)
    return frequency_hz[is_judged], level_db + a_weighting(frequency_hz[is_judged])


def decisive_tone(tones: Sequence[AudibleTone]) -> AudibleTone | None:
    """Return the most audible tone or group of tones of a spectrum."""
    return max(tones, key=lambda tone: tone.audibility_db, default=None)
