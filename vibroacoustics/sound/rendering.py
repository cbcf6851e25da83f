"""Sound pressure over time from lines and bands of noise."""

from typing import Final

import numpy as np
from scipy import fft

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.units import shaft_frequency_hz
from ..levels.bands import HALF_BAND
from ..levels.by_source import weighting_power
from .ingredients import Ingredients, SoundBands, SoundLines

SAMPLE_RATE_HZ: Final = 48000
SEED: Final = 1
"""Seed of the noise: the same for all options, so that what differs is the option."""
SHORTEST_S: Final = 1.0
LONGEST_S: Final = 600.0
_NEAR: Final = 20
"""Revolutions more or fewer, so that they end near a sample."""
_BLOCK: Final = 1024
_APART: Final = 2.5
"""Lines of the transform that noise keeps off a tone, so that neither changes the other's level."""


def whole_revolutions(duration_s: float, speed_rpm: float, sample_rate_hz: int) -> int:
    """Samples of the whole number of revolutions nearest a duration; orders go on where it repeats.

    Raises
    ------
    ParameterError
        The duration is shorter than a second or longer than ten minutes.
    """
    check_range("duration", duration_s, SHORTEST_S, LONGEST_S, "s")
    if speed_rpm <= 0.0:
        return round(duration_s * sample_rate_hz)
    shaft_hz = shaft_frequency_hz(speed_rpm)
    wanted = max(round(duration_s * shaft_hz), 1)
    near = np.arange(max(wanted - _NEAR, 1), wanted + _NEAR + 1)
    samples = near / shaft_hz * sample_rate_hz
    off = np.abs(samples - np.rint(samples))
    best = off < off.min() + 1e-6  # of those as good, the nearest
    return int(np.rint(samples[best][np.argmin(np.abs(near[best] - wanted))]))


def rendered(
    parts: Ingredients, samples: int, sample_rate_hz: int = SAMPLE_RATE_HZ, seed: int = SEED
) -> Array:
    """Sound pressure, shape (sample,), Pa.

    Parameters
    ----------
    parts : lines and noise; those above 0.45 of the sample rate are omitted
    samples : number of samples of the sound, see `whole_revolutions`
    sample_rate_hz : sample rate of the sound
    seed : seed of the phases of the noise
    """
    tones = rendered_lines(parts.lines, samples, sample_rate_hz)
    apart_hz = parts.lines.frequency_hz
    return tones + rendered_noise(parts.bands, samples, sample_rate_hz, seed, apart_hz)


def rendered_lines(lines: SoundLines, samples: int, sample_rate_hz: int) -> Array:
    """Σ Re{P exp(jωt)}, each at its frequency and phase, shape (sample,), Pa.

    In blocks: exp(jω(t₀ + τ)) is a product of matrices.
    """
    kept = lines.frequency_hz < 0.45 * sample_rate_hz
    turn = 2j * np.pi * lines.frequency_hz[kept] / sample_rate_hz
    starts = np.arange(0, samples, _BLOCK)
    at_start = lines.pressure_pa[kept] * np.exp(np.outer(starts, turn))
    onward = np.exp(np.outer(turn, np.arange(_BLOCK)))
    return np.asarray((at_start @ onward).real.ravel()[:samples])


def rendered_noise(
    bands: SoundBands,
    samples: int,
    sample_rate_hz: int,
    seed: int = SEED,
    apart_hz: Array | None = None,
) -> Array:
    """Noise with the mean square of each band over its duration, shape (sample,), Pa.

    Lines of one transform, of random phase; the sound repeats without a step. Within a band the
    power per hertz goes with 1/(f √A(f)), A = gain of the A-weighting of powers: so its A-weighted
    mean square is that of all of it at midband, as levels count it.

    Parameters
    ----------
    bands : third octaves
    samples, sample_rate_hz : number of samples and sample rate of the sound
    seed : seed of the phases; those of a frequency do not depend on the bands
    apart_hz : frequencies of tones, which the noise leaves free
    """
    hertz = fft.rfftfreq(samples, 1.0 / sample_rate_hz)
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, hertz.size)
    free = np.ones(hertz.size, dtype=bool)
    for tone in () if apart_hz is None else apart_hz:
        free &= np.abs(hertz - tone) > _APART * sample_rate_hz / samples
    square = np.zeros(hertz.size)
    for centre, effective in zip(bands.centre_hz, bands.pressure_pa, strict=True):
        if centre * HALF_BAND < 0.45 * sample_rate_hz:
            inner = (hertz >= centre / HALF_BAND) & (hertz < centre * HALF_BAND)
            inner = inner & free if np.any(inner & free) else inner
            density = 1.0 / (hertz[inner] * np.sqrt(weighting_power("A", hertz[inner])))
            square[inner] = effective**2 * density / density.sum()
    spectrum = samples * np.sqrt(square / 2.0) * np.exp(1j * phase)
    return np.asarray(fft.irfft(spectrum, samples))
