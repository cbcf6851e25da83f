"""Audibility of tones in noise, and the adjustment for them (ISO/PAS 20065, ISO 1996-2).

Levels are A-weighted. Equations are numbered as in ISO/PAS 20065:2016; the method is that of
DIN 45681:2005.
"""

from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..levels.rating import stepped_adjustment_db
from ..study.rating_rules.iso_1996_2 import ISO_1996_2
from .critical_bands import critical_bandwidth

NO_TONE_AUDIBILITY_DB: Final = -10.0
"""Audibility of a spectrum without an audible tone (equation 21)."""
TONE_MARGIN_DB: Final = 6.0
"""Level of a line over the mean noise line from which it belongs to a tone (clause 5.3.3)."""
RESOLVED_BELOW_HZ: Final = 1000.0
"""Frequency below which two tones of one critical band may be heard apart (equation 18)."""
_LEVEL_UNCERTAINTY_DB: Final = 3.0
_COVERAGE: Final = 1.645


def critical_edges_hz(frequency_hz: Array) -> tuple[Array, Array]:
    """Return lower and upper edge of the critical band around a tone, Hz (equations 3 to 5).

    The tone is the geometric mean of the edges at every frequency.

    Parameters
    ----------
    frequency_hz : frequency of the tones, any shape, Hz
    """
    tone_hz, width = np.asarray(frequency_hz), critical_bandwidth(frequency_hz)
    lower = 2.0 * tone_hz**2 / (width + np.sqrt(width**2 + 4.0 * tone_hz**2))
    return lower, lower + width


def masking_index_db(frequency_hz: Array) -> Array:
    """Return the masking index a_v = -2 - lg(1 + (f / 502 Hz)^2.5), dB (equation 13).

    Parameters
    ----------
    frequency_hz : frequency of the tones, any shape, Hz
    """
    return np.asarray(-2.0 - 0.1 * level_of_power(1.0 + (np.asarray(frequency_hz) / 502.0) ** 2.5))


def audibility_db(
    tone_db: Array, noise_line_db: Array, frequency_hz: Array, step_hz: float
) -> Array:
    """Return the audibility ΔL = L_T - L_G - a_v, dB (equations 12 and 14).

    The level of the noise in the critical band is L_G = L_S + 10 lg(Δf_c / Δf).

    Parameters
    ----------
    tone_db : levels L_T of tones, any shape, dB
    noise_line_db : mean levels L_S of a line of noise, same shape, dB
    frequency_hz : frequency of the tones, same shape, Hz
    step_hz : distance Δf of the lines, Hz
    """
    noise_db = noise_line_db + level_of_power(critical_bandwidth(frequency_hz) / step_hz)
    return np.asarray(tone_db - noise_db - masking_index_db(frequency_hz))


def extended_uncertainty_db(
    tone_db: Array, noise_db: Array, frequency_hz: float, step_hz: float
) -> float:
    """Return the extended uncertainty of an audibility, 90 % on both sides, dB (equation 27).

    Every line is uncertain by 3 dB (standard deviation), the width of the critical band by Δf.

    Parameters
    ----------
    tone_db : levels of the lines of the tone, or of the tones of one critical band, shape (line,),
        dB
    noise_db : levels of the lines of noise, shape (line,), dB
    frequency_hz : frequency of the tone, Hz
    step_hz : distance of the lines, Hz
    """
    width = float(critical_bandwidth(np.asarray(frequency_hz)))
    share = _concentration(tone_db) + _concentration(noise_db)
    variance = share * _LEVEL_UNCERTAINTY_DB**2 + (4.34 * step_hz / width) ** 2
    return float(_COVERAGE * np.sqrt(variance))


def _concentration(level_db: Array) -> float:
    """Sum of squared shares of the power."""
    power = power_of_level(level_db - np.max(level_db))
    return float(np.sum(power**2) / np.sum(power) ** 2)


def mean_uncertainty_db(audibility: Array, uncertainty_db: Array) -> float:
    """Return the extended uncertainty of the energy mean of audibilities, dB (equation 28).

    Parameters
    ----------
    audibility : decisive audibilities of the spectra, shape (spectrum,), dB
    uncertainty_db : their extended uncertainties, shape (spectrum,), dB
    """
    power = power_of_level(audibility)
    return float(np.sqrt(np.sum((power * uncertainty_db) ** 2)) / np.sum(power))


def tonal_adjustment_db(mean_audibility_db: Array) -> Array:
    """Return the tonal adjustment K_T, 0 to 6 dB (ISO 1996-2:2017, table J.1).

    Parameters
    ----------
    mean_audibility_db : energy means of decisive audibilities, any shape, dB
    """
    return stepped_adjustment_db(mean_audibility_db, ISO_1996_2)
