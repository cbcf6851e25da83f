"""Narrow-band spectra of recorded sound, and the tones that stand out of them."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed
from numpy.typing import NDArray

from ..base.arrays import Array, IndexArray
from ..base.constants import LOWEST_PROMINENT_TONE_HZ
from ..base.decibel import level_of_power
from ..base.errors import ParameterError
from .critical_bands import HIGHEST_TONE_HZ, critical_band, critical_bandwidth
from .tonality import TonalSpectrum

SEGMENT_S: Final = 4.0
"""Lines of 0.25 Hz, less than 1 % of the lowest tone."""
SEGMENTS: Final = 3
"""Segments of a short recording: fewer would leave single lines of noise that stand out like
tones."""
SHORTEST_S: Final = 3.0
LOWEST_RATE_HZ: Final = 200.0
"""Twice the upper edge of the lowest critical band."""
STANDS_OUT: Final = 4.0
"""Power of a tone's lines over the median of its critical band: 6 dB."""
WIDEST: Final = 0.15
"""Width of a discrete tone over that of its critical band."""
OUTSIDE: Final = 0.01
"""Share of a tone's power on either side of its width: the foot of a tone that starts or stops
within the recording is wide and weak."""
PAUSE: Final = 0.1
"""Power over that of the loudest segment: below it a tone pauses (10 dB)."""
SOUNDS: Final = 0.5
"""Power over that of the loudest segment from which a tone with pauses sounds: a segment whose
middle is where it starts has half of the power."""
FOOT: Final = 0.01
"""Power of a peak over that of the loudest in its critical band: a weaker one may be its foot in
the segments that reach beyond the recording, and keeps its mean."""
_HOPS: Final = 8
"""Hops per segment: the squares of windows (harmonics up to the sixth) then add up to a
constant."""
_FADE_S: Final = 0.05
"""Fade at both ends, where a step would be heard as noise of all frequencies."""
_LARGEST_SINGLE_PA: Final = 1e15
"""Largest pressure whose lines single precision holds: their squares stay below 3e38."""


@dataclass(frozen=True)
class NarrowBands:
    """Mean squares of evenly spaced lines, segment by segment.

    Segments overlap and reach beyond the ends, so that all samples have the same weight.

    Attributes
    ----------
    frequency_hz : shape (line,)
    segments : mean square, shape (segment, line), Pa²; of the samples within the recording
    share : share of each segment's squared window that is within the recording, shape (segment,)
    """

    frequency_hz: Array
    segments: NDArray[np.float32]
    share: Array

    @property
    def step_hz(self) -> float:
        """Distance of the lines."""
        return float(self.frequency_hz[1] - self.frequency_hz[0])

    @property
    def mean_square(self) -> Array:
        """Mean over the segments that are within the recording, shape (line,), Pa²."""
        is_full = self.share >= self.share.max() * (1.0 - 1e-6)
        return np.asarray(self.segments[is_full].mean(axis=0, dtype=float))

    @property
    def even_mean_square(self) -> Array:
        """Mean over the recording, its ends as its middle, shape (line,), Pa²."""
        return np.asarray(self.share @ self.segments / self.share.sum())


def narrow_bands(pressure_pa: Array, sample_rate_hz: float) -> NarrowBands:
    """Mean squares of lines of 0.25 Hz (below 12 s wider ones) of overlapping segments.

    The window (four terms of Blackman and Harris) falls to 92 dB within four lines.

    Parameters
    ----------
    pressure_pa : shape (sample,)
    sample_rate_hz : sample rate of the recording

    Raises
    ------
    ParameterError
        The recording is shorter than 3 s, or its sample rate below twice the lowest critical band.
    """
    duration = pressure_pa.size / sample_rate_hz
    if duration < SHORTEST_S:
        raise ParameterError(f"recording of {duration:.3g} s: tones need at least {SHORTEST_S:g} s")
    if sample_rate_hz < LOWEST_RATE_HZ:
        raise ParameterError(
            f"sample rate = {sample_rate_hz:g} Hz: tones need at least {LOWEST_RATE_HZ:g} Hz"
        )
    hop = round(min(SEGMENT_S, duration / SEGMENTS) * sample_rate_hz / _HOPS)
    length = _HOPS * hop
    window = scipy.signal.get_window("blackmanharris", length)
    fade = scipy.signal.windows.tukey(pressure_pa.size, 2.0 * _FADE_S / duration)
    weight = np.pad(fade**2, length)
    pressure = np.pad(fade * (pressure_pa - np.mean(pressure_pa)), length)
    starts = range(hop, pressure.size - length, hop)
    share = np.array([window**2 @ weight[start : start + length] for start in starts])
    is_huge = np.max(np.abs(pressure), initial=0.0) > _LARGEST_SINGLE_PA
    segments = np.empty((share.size, length // 2 + 1), dtype=float if is_huge else np.float32)
    for row, start in enumerate(starts):
        lines = np.abs(np.fft.rfft(window * pressure[start : start + length])) ** 2
        segments[row] = 2.0 * lines / (length * share[row])
    return NarrowBands(
        np.fft.rfftfreq(length, 1.0 / sample_rate_hz).astype(float),
        segments,
        share / np.sum(window**2),
    )


def recorded_spectrum(bands: NarrowBands) -> TonalSpectrum:
    """Tones that stand out of a narrow-band spectrum, and the noise between them.

    A tone is a peak 6 dB above the median of its critical band with 98 % of its power within 15 %
    of it. One that pauses has the level while it sounds. The noise of a band is that of the lines
    without tones, made up for those with tones: W_N = (W_tot - W_T) Δf / (Δf - Δf_T).

    Parameters
    ----------
    bands : result of `narrow_bands`
    """
    hertz, square = bands.frequency_hz, bands.mean_square
    peaks, first, last = _tone_lines(hertz, square)
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

    names = tuple(f"{hertz[peak]:.1f} Hz" for peak in peaks)
    total = np.concatenate([[0.0], np.cumsum(square)])
    level = total[last] - total[first]
    share, swing_db = np.ones_like(level), np.zeros_like(level)
    for number in np.flatnonzero(level > FOOT * _loudest_near(hertz[peaks], level)):
        history = _history(bands, peaks[number], first[number], last[number])
        level[number], share[number], swing_db[number] = history
    return TonalSpectrum(hertz[peaks], level, noise, names, share, swing_db)


def _loudest_near(hertz: Array, square: Array) -> Array:
    """Mean square of the loudest tone in the critical band of each, shape (tone,)."""
    bands = [critical_band(float(frequency)) for frequency in hertz]
    near = [square[(hertz >= band.lower) & (hertz <= band.upper)] for band in bands]
    return np.array([np.max(levels) for levels in near])


def _history(bands: NarrowBands, peak: int, first: int, last: int) -> tuple[float, float, float]:
    """Mean square of a tone while it sounds, share of the time, and its swing in dB.

    Segments that are louder than the loudest in which the tone stands out are not its own.
    """
    middle_inside = bands.share >= 0.5
    segments = bands.segments[middle_inside]
    power = segments[:, first:last].sum(axis=1, dtype=float)
    lower, upper = np.searchsorted(
        bands.frequency_hz, critical_band(float(bands.frequency_hz[peak]))
    )
    stands_out = power > STANDS_OUT * (last - first) * np.median(segments[:, lower:upper], axis=1)
    loudest = float(np.max(power[stands_out], initial=0.0))
    if np.min(power) >= PAUSE * loudest:
        sounds = np.ones(power.size, dtype=bool)
        level = float(bands.mean_square[first:last].sum())
    else:
        sounds = (power >= SOUNDS * loudest) & (power <= loudest)
        level = float(power[sounds].mean())
    low, high = np.quantile(power[sounds], (0.1, 0.9))
    return level, float(np.mean(sounds)), float(level_of_power(high / low)) if low > 0.0 else 0.0


def _tone_lines(hertz: Array, square: Array) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Peaks of the tones with their first line and that after their last."""
    high = square > STANDS_OUT * _median(hertz, square)
    peaks, _ = scipy.signal.find_peaks(np.where(high, square, 0.0), distance=4)
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
        width = _lines_with_power(square[first:last]) * (hertz[1] - hertz[0])
        if width <= WIDEST * critical_bandwidth(float(hertz[peak])):
            kept.append((peak, first, last))
    columns = np.array(kept, dtype=np.intp).reshape(-1, 3).T
    return columns[0], columns[1], columns[2]


def _lines_with_power(square: Array) -> int:
    """Number of lines between 1 and 99 % of the power."""
    power = np.cumsum(square)
    first, last = np.searchsorted(power, np.array([OUTSIDE, 1.0 - OUTSIDE]) * power[-1])
    return int(last - first) + 1


def _median(hertz: Array, square: Array) -> Array:
    """Median of the critical band about each line; none where tones are not judged."""
    highest = min(HIGHEST_TONE_HZ, float(hertz[-1]))
    centres = np.geomspace(
        LOWEST_PROMINENT_TONE_HZ, max(highest, 1.1 * LOWEST_PROMINENT_TONE_HZ), 100
    )
    medians = []
    for centre in centres:
        start, end = np.searchsorted(hertz, critical_band(float(centre)))
        medians.append(float(np.median(square[start:end])) if end > start else np.inf)
    return np.interp(hertz, centres, medians, left=np.inf, right=np.inf)
