"""Octave and third-octave bands (IEC 61260-1:2014, base ten); energy of a signal in them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array
from ..base.errors import ParameterError

OCTAVE_RATIO: Final = 10.0**0.3
"""G (equation 1)."""
HALF_BAND: Final = OCTAVE_RATIO ** (1.0 / 6.0)
"""Upper edge of a third octave over its centre, 10^0.05."""
REFERENCE_FREQUENCY_HZ: Final = 1000.0
"""f_r (3.4)."""

_NOMINAL: Final = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
"""Nominal mid-band frequencies of the third octaves of a decade (Annex E)."""


@dataclass(frozen=True, order=True)
class Band:
    """An octave (1 band an octave) or third-octave band (3), counted from the one at 1 kHz."""

    bands_per_octave: int
    index: int

    def __post_init__(self) -> None:
        if self.bands_per_octave not in (1, 3):
            raise ParameterError(
                f"bands_per_octave = {self.bands_per_octave}: must be 1 (octaves) or 3 (thirds)"
            )

    @property
    def middle_hz(self) -> float:
        """Exact mid-band frequency f_m = f_r G^(x/b) (equation 2)."""
        return float(REFERENCE_FREQUENCY_HZ * OCTAVE_RATIO ** (self.index / self.bands_per_octave))

    @property
    def lower_hz(self) -> float:
        """Lower band-edge frequency f_1 = f_m G^(-1/2b) (equation 4)."""
        return self.middle_hz * float(OCTAVE_RATIO ** (-0.5 / self.bands_per_octave))

    @property
    def upper_hz(self) -> float:
        """Upper band-edge frequency f_2 = f_m G^(+1/2b) (equation 5)."""
        return self.middle_hz * float(OCTAVE_RATIO ** (0.5 / self.bands_per_octave))

    @property
    def nominal_hz(self) -> float:
        """Frequency by which the band is called, such as 31.5 or 1250 (Annex E)."""
        decade, third = divmod(3 // self.bands_per_octave * self.index + 30, len(_NOMINAL))
        return round(_NOMINAL[third] * 10.0**decade, 6)


def bands_between(bands_per_octave: int, lowest_hz: float, highest_hz: float) -> tuple[Band, ...]:
    """Bands from the one that holds `lowest_hz` to the one that holds `highest_hz`.

    Raises
    ------
    ParameterError
        The frequencies are not above zero and rising, or there are no such bands.
    """
    if not 0.0 < lowest_hz <= highest_hz < np.inf:
        raise ParameterError(
            f"bands from {lowest_hz:g} to {highest_hz:g} Hz: must rise and lie above 0 Hz"
        )
    number = np.log10(np.array([lowest_hz, highest_hz]) / REFERENCE_FREQUENCY_HZ) / 0.3
    first, last = np.rint(number * Band(bands_per_octave, 0).bands_per_octave).astype(int)
    return tuple(Band(bands_per_octave, index) for index in range(int(first), int(last) + 1))


def measurable_bands(bands: Iterable[Band], sample_rate_hz: float) -> tuple[Band, ...]:
    """Those of the bands that lie wholly below half the sample rate."""
    return tuple(band for band in bands if band.upper_hz < 0.5 * sample_rate_hz)


def check_measurable(bands: Iterable[Band], sample_rate_hz: float) -> None:
    """Refuse bands that reach half the sample rate.

    Raises
    ------
    ParameterError
        A band does.
    """
    for band in bands:
        if not band.upper_hz < 0.5 * sample_rate_hz:
            raise ParameterError(
                f"band {band.nominal_hz:g} Hz: reaches up to {band.upper_hz:.5g} Hz, must "
                f"end below half the sample rate, {0.5 * sample_rate_hz:g} Hz"
            )


def band_mean_square(signal: Array, sample_rate_hz: float, bands: Sequence[Band]) -> Array:
    """Mean square of a signal in bands, from the lines of one Fourier transform of all of it.

    A line stands for the interval of its width around it; where a band edge cuts it, its energy
    is shared in proportion. So adjacent bands add up, and all frequencies together give the
    signal's mean square to rounding (Parseval). No window: a tone between two lines leaks; in a
    recording of T seconds it puts about 1/(π² d² T) of its energy, at worst four times that, into
    each hertz at a distance d.

    Parameters
    ----------
    signal : shape (..., time), any unit
    sample_rate_hz : sample rate of the signal
    bands : below half the sample rate

    Returns
    -------
    shape (..., band), unit squared

    Raises
    ------
    ParameterError
        A band reaches half the sample rate.
    """
    check_measurable(bands, sample_rate_hz)
    samples = signal.shape[-1]
    spectrum = fft.rfft(signal)
    squares = spectrum.view(float)
    np.square(squares, out=squares)  # in place: of a long recording it is large
    energy = spectrum.real + spectrum.imag
    energy *= 2.0 / samples**2
    energy[..., 0] *= 0.5
    energy[..., (samples + 1) // 2 :] *= 0.5
    return band_sums(energy, sample_rate_hz, samples, bands)


def band_sums(energy: Array, sample_rate_hz: float, samples: int, bands: Sequence[Band]) -> Array:
    """Energy in bands from that of the lines of a transform; a line that an edge cuts is shared.

    Parameters
    ----------
    energy : energy of the lines from 0 Hz to half the sample rate, shape (..., line), any unit
    sample_rate_hz : sample rate of the signal
    samples : number of samples of the transform
    bands : below half the sample rate

    Returns
    -------
    shape (..., band), same unit
    """
    edges = {edge for band in bands for edge in (band.lower_hz, band.upper_hz)}
    lines = {edge: _line(edge, sample_rate_hz, samples) for edge in edges}
    sums = np.empty((*energy.shape[:-1], len(bands)))
    for number, band in enumerate(bands):
        first, below = lines[band.lower_hz]
        last, share = lines[band.upper_hz]
        cut = share * energy[..., last] - below * energy[..., first]
        sums[..., number] = energy[..., first:last].sum(axis=-1) + cut
    return np.maximum(sums, 0.0)


def _line(frequency_hz: float, sample_rate_hz: float, samples: int) -> tuple[int, float]:
    """Line in whose interval a frequency lies, and the share of the interval below it."""
    width_hz = sample_rate_hz / samples
    line = int(np.floor(frequency_hz / width_hz + 0.5))
    lower = max((line - 0.5) * width_hz, 0.0)
    upper = min((line + 0.5) * width_hz, 0.5 * sample_rate_hz)
    return line, (frequency_hz - lower) / (upper - lower)
