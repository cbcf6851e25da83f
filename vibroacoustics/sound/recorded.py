"""Narrow-band spectra of recorded sound, and the tones that stand out of them."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import signal as filters

from ..base.arrays import Array, IndexArray
from ..base.errors import ParameterError
from .critical_bands import HIGHEST_TONE_HZ, LOWEST_TONE_HZ, critical_band, critical_bandwidth
from .tonality import TonalSpectrum

SEGMENT_S: Final = 4.0
"""Lines of 0.25 Hz, less than 1 % of the lowest tone."""
SEGMENTS: Final = 3
"""Of a short recording: fewer would leave single lines of noise that stand out like tones."""
SHORTEST_S: Final = 3.0
STANDS_OUT: Final = 4.0
"""Of a tone's lines over the median of its critical band, as powers: 6 dB."""
WIDEST: Final = 0.15
"""Width of a discrete tone over that of its critical band."""


@dataclass(frozen=True)
class NarrowBands:
    """Mean squares of evenly spaced lines.

    Attributes
    ----------
    frequency_hz : shape (line,)
    mean_square : shape (line,), Pa²
    """

    frequency_hz: Array
    mean_square: Array

    @property
    def step_hz(self) -> float:
        """Distance of the lines."""
        return float(self.frequency_hz[1] - self.frequency_hz[0])


def narrow_bands(pressure_pa: Array, sample_rate_hz: float) -> NarrowBands:
    """Mean squares of lines of 0.25 Hz (below 12 s wider ones), averaged over a recording (Welch).

    The window (four terms of Blackman and Harris) falls to 92 dB within four lines.

    Parameters
    ----------
    pressure_pa : shape (sample,)
    sample_rate_hz : of the recording

    Raises
    ------
    ParameterError
        The recording is shorter than 3 s.
    """
    duration = pressure_pa.size / sample_rate_hz
    if duration < SHORTEST_S:
        raise ParameterError(f"recording of {duration:.3g} s: tones need at least {SHORTEST_S:g} s")
    length = round(min(SEGMENT_S, duration / SEGMENTS) * sample_rate_hz)
    hertz, density = filters.welch(
        pressure_pa, sample_rate_hz, "blackmanharris", length, length * 3 // 4
    )
    return NarrowBands(hertz, density * hertz[1])


def recorded_spectrum(bands: NarrowBands) -> TonalSpectrum:
    """Tones that stand out of a narrow-band spectrum, and the noise between them.

    A tone is a peak 6 dB above the median of its critical band that is no wider than 15 % of it.
    The noise of a band is that of the lines without tones, made up for those with tones:
    W_N = (W_tot - W_T) Δf / (Δf - Δf_T).

    Parameters
    ----------
    bands : of `narrow_bands`
    """
    hertz, square = bands.frequency_hz, bands.mean_square
    peaks, first, last = _tone_lines(bands)
    is_noise = np.ones(hertz.size, dtype=bool)
    for start, end in zip(first, last, strict=True):
        is_noise[start:end] = False
    of_noise = np.concatenate([[0.0], np.cumsum(np.where(is_noise, square, 0.0))])
    count = np.concatenate([[0], np.cumsum(is_noise)])

    def noise(lower: float, upper: float) -> float:
        start, end = np.searchsorted(hertz, (lower, upper))
        lines = count[end] - count[start]
        made_up = (end - start) / lines if lines else 0.0
        return float((of_noise[end] - of_noise[start]) * made_up)

    total = np.concatenate([[0.0], np.cumsum(square)])
    names = tuple(f"{hertz[peak]:.1f} Hz" for peak in peaks)
    return TonalSpectrum(hertz[peaks], total[last] - total[first], noise, names)


def _tone_lines(bands: NarrowBands) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Peaks of the tones with their first line and that after their last."""
    hertz, square = bands.frequency_hz, bands.mean_square
    high = square > STANDS_OUT * _median(bands)
    peaks, _ = filters.find_peaks(np.where(high, square, 0.0), distance=4)
    kept = []
    for number, peak in enumerate(peaks):
        before = peaks[number - 1] if number else 0
        after = peaks[number + 1] if number + 1 < peaks.size else hertz.size - 1
        first = before + int(np.argmin(square[before : peak + 1]))
        last = peak + int(np.argmin(square[peak : after + 1]))
        low = np.flatnonzero(~high[first : peak + 1])
        first += int(low[-1]) + 1 if low.size else 0
        low = np.flatnonzero(~high[peak : last + 1])
        last = peak + int(low[0]) if low.size else last
        if (last - first) * bands.step_hz <= WIDEST * critical_bandwidth(float(hertz[peak])):
            kept.append((peak, first, last))
    columns = np.array(kept, dtype=np.intp).reshape(-1, 3).T
    return columns[0], columns[1], columns[2]


def _median(bands: NarrowBands) -> Array:
    """Median of the critical band about each line; none where tones are not judged."""
    hertz, square = bands.frequency_hz, bands.mean_square
    highest = min(HIGHEST_TONE_HZ, float(hertz[-1]))
    centres = np.geomspace(LOWEST_TONE_HZ, max(highest, 1.1 * LOWEST_TONE_HZ), 100)
    medians = []
    for centre in centres:
        start, end = np.searchsorted(hertz, critical_band(float(centre)))
        medians.append(float(np.median(square[start:end])) if end > start else np.inf)
    return np.interp(hertz, centres, medians, left=np.inf, right=np.inf)
