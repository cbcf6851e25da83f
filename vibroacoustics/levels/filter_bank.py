"""Octave and third-octave filters in the time domain, class 1 of IEC 61260-1:2014.

The acceptance limits of Table 1 are from secondary sources that agree (the OctFilter class of L.
Jacomussi and the documents of phonometry, J. M. Requena-Plens); the standard's text was not at
hand.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from .bands import OCTAVE_RATIO, Band, check_measurable

FILTER_ORDER: Final = 4
"""Order of the Butterworth low-pass behind each band-pass. With order 3 the bilinear transform
lifts the lower skirt out of class 1 from a quarter of the sample rate on; order 4 stays within it
up to 1 % below half the sample rate, and a higher one would only ring longer."""

# Table 1, class 1: powers of G of the breakpoints of an octave filter, on either side, and the
# relative attenuation in dB that is allowed there.
_PASS_POWER: Final = (0.0, 1 / 8, 1 / 4, 3 / 8, 1 / 2)
_PASS_GREATEST_DB: Final = (0.4, 0.5, 0.7, 1.4, 5.3)
_PASS_LEAST_DB: Final = -0.4
_STOP_POWER: Final = (1 / 2, 1.0, 2.0, 3.0, 4.0)
_STOP_LEAST_DB: Final = (1.2, 16.6, 40.5, 60.0, 70.0)


def class_1_limits_db(frequency_ratio: Array, bands_per_octave: int) -> tuple[Array, Array]:
    """Least and greatest relative attenuation of a class 1 filter (5.10 and Table 1), dB.

    Between the breakpoints the limits are linear over the logarithm of the frequency. A filter of
    1/b octave has the breakpoint 1 + (G^(1/2b) - 1) / (G^(1/2) - 1) (Ω - 1) where the octave
    filter has Ω > 1, and the inverse of it below the mid-band frequency.

    Parameters
    ----------
    frequency_ratio : frequency over mid-band frequency, above zero, shape (...)
    bands_per_octave : 1 or 3

    Returns
    -------
    least and greatest attenuation; the greatest is infinite outside the band
    """
    distance = np.abs(np.log(frequency_ratio))
    in_pass, in_stop = (
        _breakpoints(power, bands_per_octave) for power in (_PASS_POWER, _STOP_POWER)
    )
    outside = distance >= in_stop[0]
    least = np.where(outside, np.interp(distance, in_stop, _STOP_LEAST_DB), _PASS_LEAST_DB)
    greatest = np.where(outside, np.inf, np.interp(distance, in_pass, _PASS_GREATEST_DB))
    return least, greatest


def _breakpoints(power: tuple[float, ...], bands_per_octave: int) -> Array:
    """Logarithms of the breakpoints above the mid-band frequency."""
    squeeze = (OCTAVE_RATIO ** (0.5 / bands_per_octave) - 1.0) / (OCTAVE_RATIO**0.5 - 1.0)
    return np.asarray(np.log1p(squeeze * (OCTAVE_RATIO ** np.array(power) - 1.0)))


def band_filter(band: Band, sample_rate_hz: float) -> Array:
    """Second-order sections of a band's Butterworth filter, -3 dB at the band edges.

    No band is decimated: in double precision, rounding at the full rate is 7e-12 of what comes
    through at 25 Hz and 51.2 kHz, and 4e-10 at 1 Hz (measured against extended precision).

    Raises
    ------
    ParameterError
        The band reaches half the sample rate, or comes so close to it that class 1 is not met.
    """
    check_measurable([band], sample_rate_hz)
    edges = [band.lower_hz, band.upper_hz]
    sections = scipy.signal.butter(FILTER_ORDER, edges, "bandpass", output="sos", fs=sample_rate_hz)
    ratio = np.asarray(np.geomspace(OCTAVE_RATIO**-5, OCTAVE_RATIO**5, 2001), dtype=np.float64)
    ratio = ratio[ratio * band.middle_hz < 0.5 * sample_rate_hz]
    response = scipy.signal.sosfreqz(sections, ratio * band.middle_hz, fs=sample_rate_hz)[1]
    attenuation = -level_of_amplitude(np.abs(response))
    least, greatest = class_1_limits_db(ratio, band.bands_per_octave)
    if not np.all((least <= attenuation) & (attenuation <= greatest)):
        raise ParameterError(
            f"band {band.nominal_hz:g} Hz: too close to half the sample rate, "
            f"{0.5 * sample_rate_hz:g} Hz, for a class 1 filter"
        )
    return np.asarray(sections)


def filtered_energy(
    energy: Array, frequency_hz: Array, sample_rate_hz: float, bands: Sequence[Band]
) -> Array:
    """Energy that the bands' filters let through of lines, shape (..., band), same unit.

    A filter's skirts let in what lies beside its band: beside a strong tone it reads 15 to 20 dB
    more than the sum of the lines within the band (`bands.band_sums`).

    Parameters
    ----------
    energy : energy of lines, shape (..., line), any unit
    frequency_hz : frequency of the lines, shape (line,)
    sample_rate_hz : sample rate of the signal
    bands : below half the sample rate
    """
    passed = np.empty((*energy.shape[:-1], len(bands)))
    for number, band in enumerate(bands):
        filter_ = band_filter(band, sample_rate_hz)
        response = scipy.signal.sosfreqz(filter_, frequency_hz, fs=sample_rate_hz)[1]
        passed[..., number] = energy @ np.abs(response) ** 2
    return passed


def band_signal(signal: Array, sample_rate_hz: float, band: Band) -> Array:
    """Return the signal behind a band's filter, from rest.

    Parameters
    ----------
    signal : shape (..., time), any unit
    sample_rate_hz : sample rate of the signal
    band : below half the sample rate

    Returns
    -------
    same shape and unit; the filter settles in a few times the inverse of the band's width
    """
    return np.asarray(scipy.signal.sosfilt(band_filter(band, sample_rate_hz), signal))
