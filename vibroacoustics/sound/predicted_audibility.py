"""Audibility of the tones of computed sound, over arrays of spectra (ISO/PAS 20065)."""

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array
from ..base.constants import LOWEST_AUDIBLE_TONE_HZ, REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, mean_square_level, power_of_level
from ..levels.bands import HALF_BAND
from ..levels.by_source import weighting_power
from ..levels.hearing import hearing_threshold_db
from .audibility import (
    NO_TONE_AUDIBILITY_DB,
    RESOLVED_BELOW_HZ,
    TONE_MARGIN_DB,
    critical_edges_hz,
    masking_index_db,
)
from .audible_tones import FEWEST_LINES, HIGHEST_HZ, STEP_HZ
from .critical_bands import critical_bandwidth, proximity_hz
from .prominence import strongest

MOST_AUDIBLE_DB: Final = 60.0
_MERGED_HZ: Final = 1.5 * STEP_HZ
"""Distance below which two lines are one peak of a narrow-band spectrum."""
_MOST_PASSES: Final = 8
_PARTS: Final = 3
"""Parts of a third octave, each of one density: A-weighting rises 7 dB an octave at 100 Hz."""
_SIDE_HZ: Final = FEWEST_LINES * STEP_HZ


class PredictedAudibility(NamedTuple):
    """Audibility of computed tones.

    Attributes
    ----------
    tone_db : audibility of each line by itself, `NO_TONE_AUDIBILITY_DB` to `MOST_AUDIBLE_DB`,
        shape (..., line)
    decisive_db : audibility of the most audible tone, or of the tones of one critical band
        together, same range, shape (...)
    """

    tone_db: Array
    decisive_db: Array


class _Noise(NamedTuple):
    """Parts of third octaves in the critical band of a tone.

    Attributes
    ----------
    band : number of the third octave, shape (part,)
    share : A-weighted share of its power, shape (part,)
    width_hz : width of the part, shape (part,)
    is_left : whether the part is below the tone, shape (part,)
    """

    band: NDArray[np.intp]
    share: Array
    width_hz: Array
    is_left: NDArray[np.bool_]


class _Bands(NamedTuple):
    """Critical bands of the lines that may be tones.

    Attributes
    ----------
    number : position of these lines among all, shape (tone,)
    weight : A-weighting as a power, shape (tone,)
    is_merged : whether a weaker line is part of the peak of a stronger one, (stronger, weaker)
    is_inside : whether a line is in the critical band of a tone, shape (line, tone)
    is_apart : whether a pair of tones is heard apart, shape (line, tone)
    noise : parts of third octaves in the critical band of each tone
    width_hz : width of the critical bands, shape (tone,)
    index_db : masking index, shape (tone,)
    threshold_db : threshold of hearing, shape (tone,)
    """

    number: NDArray[np.intp]
    weight: Array
    is_merged: NDArray[np.bool_]
    is_inside: NDArray[np.bool_]
    is_apart: NDArray[np.bool_]
    noise: tuple[_Noise, ...]
    width_hz: Array
    index_db: Array
    threshold_db: Array


def predicted_audibility(
    frequency_hz: Array, square: Array, noise: Array, centre_hz: Array
) -> PredictedAudibility:
    """Rate lines in the noise of the same spectrum as a long narrow-band spectrum would.

    A line less than 6 dB over the mean noise line (of 2.7 Hz) counts as noise. A line without
    noise in its critical band, or below the threshold of hearing, is not rated.

    Parameters
    ----------
    frequency_hz : frequency of the lines, not a number where there is none, shape (line,), Hz
    square : mean squares of the lines, shape (..., line), Pa²
    noise : mean squares of the noise in third octaves, shape (..., band), Pa²; within a band it is
        even over the logarithm of frequency
    centre_hz : exact midband frequencies, shape (band,), Hz
    """
    bands = _bands(tuple(frequency_hz.tolist()), tuple(centre_hz.tolist()))
    audibility = np.full(square.shape, NO_TONE_AUDIBILITY_DB)
    if not bands.number.size:
        return PredictedAudibility(
            audibility, audibility.max(axis=-1, initial=NO_TONE_AUDIBILITY_DB)
        )
    lines = square.reshape(-1, square.shape[-1])[:, bands.number]
    lines = strongest(lines, bands.is_merged)
    loud_enough = mean_square_level(lines, REFERENCE_PRESSURE_PA) >= bands.threshold_db
    lines = lines * bands.weight
    masking = _masking_noise(lines, noise.reshape(-1, noise.shape[-1]), bands)
    tone_db = np.where(loud_enough, _audibility(lines, masking, bands), NO_TONE_AUDIBILITY_DB)
    decisive_db = np.maximum(tone_db.max(axis=1), _joined(lines, masking, tone_db, bands))
    audibility[..., bands.number] = tone_db.reshape(*square.shape[:-1], -1)
    return PredictedAudibility(audibility, decisive_db.reshape(square.shape[:-1]))


def _masking_noise(lines: Array, thirds: Array, bands: _Bands) -> Array:
    """Noise of the critical bands with the lines too weak to be tones, shape (spectrum, tone)."""
    is_new = np.append(True, (np.diff(thirds, axis=0) != 0.0).any(axis=1))  # many have one noise
    densities = [_mean_density(thirds[is_new], parts) for parts in bands.noise]
    noise = (np.stack(densities, axis=1) * bands.width_hz)[np.cumsum(is_new) - 1]
    margin = power_of_level(TONE_MARGIN_DB) * STEP_HZ / bands.width_hz
    masking = noise
    is_weak = np.zeros(lines.shape, dtype=bool)
    for _ in range(_MOST_PASSES):
        weak = lines <= margin * masking
        if np.array_equal(weak, is_weak):
            break
        is_weak = weak
        # The line of a tone is no part of the noise that masks it.
        weak_lines = np.where(weak, lines, 0.0)
        masking = noise + weak_lines @ bands.is_inside - weak_lines
    return np.asarray(np.where(noise > 0.0, masking, 0.0))


def _mean_density(thirds: Array, parts: _Noise) -> Array:
    """Mean density of the noise around a tone, without parts 6 dB over it, (spectrum,), Pa²/Hz."""
    power = thirds[:, parts.band] * parts.share
    density = power / parts.width_hz
    is_kept = np.ones(power.shape, dtype=bool)
    mean = power.sum(axis=1) / parts.width_hz.sum()
    for _ in range(_MOST_PASSES):
        kept = is_kept & (density <= power_of_level(TONE_MARGIN_DB) * mean[:, None])
        left_hz = kept @ (parts.width_hz * parts.is_left)
        right_hz = kept @ (parts.width_hz * ~parts.is_left)
        kept[np.minimum(left_hz, right_hz) < _SIDE_HZ] = True
        kept &= is_kept
        if np.array_equal(kept, is_kept):
            break
        is_kept = kept
        mean = np.where(is_kept, power, 0.0).sum(axis=1) / (is_kept @ parts.width_hz)
    return np.asarray(mean)


def _audibility(power: Array, masking: Array, bands: _Bands) -> Array:
    """Audibility of A-weighted mean squares, none without noise, shape (spectrum, tone)."""
    rated = (power > 0.0) & (masking > 0.0)
    ratio = np.where(rated, power, 1.0) / np.where(rated, masking, 1.0)
    audibility = level_of_power(ratio) - bands.index_db
    limited = np.clip(audibility, NO_TONE_AUDIBILITY_DB, MOST_AUDIBLE_DB)
    return np.where(rated, limited, NO_TONE_AUDIBILITY_DB)


def _joined(lines: Array, masking: Array, tone_db: Array, bands: _Bands) -> Array:
    """Largest audibility of the audible tones of one critical band together, (spectrum,)."""
    audible = tone_db > 0.0
    count = audible @ bands.is_inside.astype(float)
    apart = audible @ (bands.is_inside & bands.is_apart).astype(float)
    together = np.where(audible, lines, 0.0) @ bands.is_inside
    most_audible = np.stack(
        [tone_db[:, members].max(axis=1) for members in bands.is_inside.T], axis=1
    )
    is_joined = audible & (tone_db >= most_audible) & (count > 1) & ~((count == 2) & (apart > 0))
    joined_db = _audibility(together, masking, bands)
    return np.asarray(np.where(is_joined, joined_db, NO_TONE_AUDIBILITY_DB).max(axis=1))


@lru_cache(maxsize=64)
def _bands(frequency_hz: tuple[float, ...], centre_hz: tuple[float, ...]) -> _Bands:
    every, centre = np.array(frequency_hz), np.array(centre_hz)
    number = np.flatnonzero((every >= LOWEST_AUDIBLE_TONE_HZ) & (every <= HIGHEST_HZ))
    hertz = every[number]
    lower, upper = critical_edges_hz(hertz)
    distance = np.abs(hertz[:, None] - hertz)
    below = hertz < RESOLVED_BELOW_HZ
    return _Bands(
        number,
        weighting_power("A", hertz),
        distance < _MERGED_HZ,
        (hertz[:, None] >= lower) & (hertz[:, None] <= upper),
        below[:, None] & below & (distance > proximity_hz(hertz)),
        tuple(_noise_parts(*edges, centre) for edges in zip(lower, hertz, upper, strict=True)),
        critical_bandwidth(hertz),
        masking_index_db(hertz),
        np.array([hearing_threshold_db(tone_hz) for tone_hz in hertz.tolist()]),
    )


def _noise_parts(lower_hz: float, tone_hz: float, upper_hz: float, centre_hz: Array) -> _Noise:
    """Parts of third octaves in a critical band, cut at its tone."""
    steps = HALF_BAND ** np.linspace(-1.0, 1.0, _PARTS + 1)
    edges = np.sort(np.append(np.outer(centre_hz, steps).ravel(), [lower_hz, tone_hz, upper_hz]))
    edges = edges[(edges >= lower_hz) & (edges <= upper_hz)]
    edges = edges[np.append(True, np.diff(edges) > 1e-9 * tone_hz)]
    middle = np.sqrt(edges[1:] * edges[:-1])
    band = np.abs(np.log(middle[:, None] / centre_hz)).argmin(axis=1)
    share = np.log(edges[1:] / edges[:-1]) / (2.0 * np.log(HALF_BAND))
    is_inside = np.abs(np.log(middle / centre_hz[band])) <= np.log(HALF_BAND)
    weighted = share * is_inside * weighting_power("A", middle)
    return _Noise(band, weighted, np.diff(edges), middle < tone_hz)
