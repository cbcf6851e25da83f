"""Audibility of the tones of a sound over time (ISO/PAS 20065), and the drift of its lines."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
import scipy
from scipy.ndimage import median_filter
from scipy.signal import get_window

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import energy_mean, mean_square_level
from ..base.errors import ParameterError
from ..base.weighting import a_weighting
from .audibility import NO_TONE_AUDIBILITY_DB, critical_edges_hz, mean_uncertainty_db
from .audible_tones import HIGHEST_HZ, STEP_HZ, AudibleTone, audible_tones

_BLOCK_S: Final = 0.5
_PAIRS: Final = 30
"""Pairs of spectra that are compared, over the whole signal."""
_PER_OCTAVE: Final = 48
_RANGE_HZ: Final = (150.0, 4000.0)
_MOST: Final = 16
"""Largest shift between two spectra, in steps of the logarithm of frequency."""
_LEAST_OCTAVES: Final = 0.25
_AGREEING: Final = 0.8
"""Share of the pairs that shift one way in a run-up (assumed)."""
_ALIKE: Final = 0.5
"""Correlation above which two spectra hold the same lines; spectra of noise have less (assumed)."""


def drift_octaves(signal: Array, sample_rate_hz: float) -> float:
    """Estimate by how many octaves all lines rise or fall together; 0 of a steady signal.

    Spectra over the logarithm of frequency, one after the other, are shifted until they correlate
    best. A drift counts from a quarter of an octave on, where four of five shifts agree in sign.

    Parameters
    ----------
    signal : shape (sample,)
    sample_rate_hz : sample rate, Hz
    """
    length = round(_BLOCK_S * sample_rate_hz)
    highest = min(_RANGE_HZ[1], 0.45 * sample_rate_hz)
    count = min(_PAIRS, signal.size // length - 1)
    if count < 4 or highest < 2.0 * _RANGE_HZ[0]:
        return 0.0
    steps = int(_PER_OCTAVE * np.log2(highest / _RANGE_HZ[0]))
    hertz = _RANGE_HZ[0] * 2.0 ** (np.arange(steps) / _PER_OCTAVE)
    begins = np.linspace(0, signal.size - length, count + 1).astype(int)
    window = get_window("hann", length)
    shapes = []
    for begin in begins:
        spectrum = np.abs(np.fft.rfft(window * signal[begin : begin + length])) ** 2
        level = np.log(np.interp(hertz, np.fft.rfftfreq(length, 1.0 / sample_rate_hz), spectrum)
                       + 1e-12 * spectrum.max() + np.finfo(float).tiny)  # fmt: skip
        shapes.append(np.maximum(level - median_filter(level, _PER_OCTAVE // 2 + 1), 0.0))
    shifts = np.array([_shift(*pair) for pair in pairwise(shapes)])
    octaves = float(shifts.sum()) / _PER_OCTAVE
    agreeing = float(np.mean(np.sign(shifts) == np.sign(octaves)))
    return octaves if abs(octaves) >= _LEAST_OCTAVES and agreeing >= _AGREEING else 0.0


def _shift(first: Array, second: Array) -> int:
    """Steps by which the lines of the second spectrum are above those of the first; 0 of noise."""
    inner = first[_MOST:-_MOST]
    parts = np.lib.stride_tricks.sliding_window_view(second, inner.size)
    size = np.linalg.norm(inner) * np.linalg.norm(parts, axis=1)
    likeness = np.divide(parts @ inner, size, out=np.zeros(len(parts)), where=size > 0.0)
    best = int(np.argmax(likeness))
    return best - _MOST if likeness[best] >= _ALIKE else 0


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
