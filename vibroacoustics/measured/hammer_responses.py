"""Frequency responses of hits: H1, H2, coherence, scatter, and what is left at a block's end."""

from typing import Final, NamedTuple

import numpy as np
from scipy import signal

from ..base.arrays import Array, ComplexArray

LARGEST_END: Final = 0.01
"""Largest amplitude of a mode at the end of a block, share of its begin: 4.6 time constants. Six
leave errors below 0.5 % (Trethewey and Cafeo 1992, Int. J. Modal Analysis 7, 129)."""
LEAST_PEAK: Final = 20.0
"""Least power of a mode in the second half of a block over the median of all lines; assumed."""
STEADY: Final = 0.9
"""Share of its begin above which a line does not decay: hum, or a machine that runs; assumed."""
LEAST_NOISE_SAMPLES: Final = 32
"""Fewest samples before a hit: their power is within 25 %."""
LEAST_NOISE: Final = 1e-10
"""Least power before the hit over that of the record; rounding noise is below."""
LARGEST_FALL: Final = 0.25
"""Power of the noise at the end over that before the hit; assumed."""
LEAST_FORCE: Final = 0.01
"""Least power of the force, share of its largest: 20 dB below; assumed."""


class Estimates(NamedTuple):
    """Frequency responses of several hits; each of shape (frequency,).

    Attributes
    ----------
    h1 : S_yf / S_ff, without bias by noise in the response
    h2 : S_yy / S_fy, without bias by noise in the force
    coherence : |S_yf|² / (S_ff S_yy), of one hit not a number
    scatter : standard deviation of the hits' own functions over |H1|, of one hit not a number
    """

    h1: ComplexArray
    h2: ComplexArray
    coherence: Array
    scatter: Array


class Ending(NamedTuple):
    """Amplitude of the slowest mode at the end of a block over its begin, and its frequency, Hz."""

    share: float
    frequency_hz: float


def estimates(force: ComplexArray, response: ComplexArray) -> Estimates:
    """Return H1, H2, coherence and scatter of hits (Ewins, Modal Testing, 2000, section 3.8).

    Parameters
    ----------
    force, response : spectra F and Y of each hit, shape (hit, frequency)
    """
    force_power = np.sum(np.abs(force) ** 2, axis=0).clip(min=1e-300)
    response_power = np.sum(np.abs(response) ** 2, axis=0).clip(min=1e-300)
    cross = np.sum(response * force.conj(), axis=0)
    h1 = cross / force_power
    h2 = response_power / np.where(cross == 0.0, 1e-300, cross.conj())
    if len(force) == 1:
        nothing = np.full(h1.shape, np.nan)
        return Estimates(h1, h2, nothing, nothing)
    coherence = np.abs(cross) ** 2 / (force_power * response_power)
    by_hit = response / np.where(force == 0.0, 1e-300, force)
    scatter = np.std(by_hit, axis=0, ddof=1) / np.abs(h1).clip(min=1e-300)
    return Estimates(h1, h2, coherence, scatter)


def block_ending(response: Array, sample_rate_hz: float) -> Ending:
    """Return what is left of the slowest mode at the end of blocks.

    A mode falls from the first half of a block to the second, each under a Hann window, by the
    root of its fall over the block: r = exp(-σT/2), whatever the window.

    Parameters
    ----------
    response : blocks of all hits, shape (hit, time)
    sample_rate_hz : sample rate
    """
    half = response.shape[1] // 2
    window = signal.windows.hann(half, sym=False)
    halves = response[:, : 2 * half].reshape(len(response), 2, half)
    halves = halves - halves.mean(axis=2, keepdims=True)
    first, second = np.sum(np.abs(np.fft.rfft(halves * window)) ** 2, axis=0)
    floor = float(np.median(second))
    peaks, _ = signal.find_peaks(second, height=LEAST_PEAK * floor)
    if floor == 0.0 or not peaks.size:
        return Ending(0.0, 0.0)
    share = np.minimum(second[peaks] / first[peaks].clip(min=1e-300), 1.0)
    worst = int(np.argmax(share))
    return Ending(float(share[worst]), float(peaks[worst]) * sample_rate_hz / half)


def window_constant_s(response: Array, before: int, sample_rate_hz: float) -> float:
    """Return the time constant of an exponential window that a recorder has applied; 0 without.

    Noise of a sensor is as high at the end of a record as before the hit. If it has fallen to
    less than half, a window has lowered it. Second differences keep the noise at high frequencies,
    where structures decay soonest.

    Parameters
    ----------
    response : record of one hit, shape (time,)
    before : number of samples before the hit
    sample_rate_hz : sample rate
    """
    if before < LEAST_NOISE_SAMPLES:
        return 0.0
    noise = np.diff(response, n=2)
    last = max(noise.size // 20, LEAST_NOISE_SAMPLES)
    first_square, last_square = np.mean(noise[: before - 2] ** 2), np.mean(noise[-last:] ** 2)
    is_noisy = first_square > LEAST_NOISE * np.mean(noise**2)
    if not is_noisy or not 0.0 < last_square < LARGEST_FALL * first_square:
        return 0.0
    between_s = (noise.size - 0.5 * (last + before)) / sample_rate_hz
    return float(between_s / (-0.5 * np.log(last_square / first_square)))


def highest_frequency_hz(force: ComplexArray, frequency_hz: Array) -> float:
    """Return the frequency at which the mean force spectrum has fallen by 20 dB.

    Parameters
    ----------
    force : spectra of the hits, shape (hit, frequency)
    frequency_hz : shape (frequency,)
    """
    power = np.mean(np.abs(force) ** 2, axis=0)
    below = np.flatnonzero(power < LEAST_FORCE * power.max())
    return float(frequency_hz[max(below[0] - 1, 0)] if below.size else frequency_hz[-1])
