"""Prominence of the tones of computed sound, over arrays of spectra (ECMA-418-1)."""

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array
from ..base.constants import LOWEST_PROMINENT_TONE_HZ, REFERENCE_PRESSURE_PA
from ..base.decibel import NO_TONE_DB, SILENCE_DB, level_of_power, mean_square_level
from ..levels.bands import HALF_BAND
from ..levels.hearing import hearing_threshold_db
from .critical_bands import (
    CUT_BELOW_HZ,
    HIGHEST_TONE_HZ,
    Edges,
    band_above,
    band_below,
    critical_band,
    noise_criterion_db,
    prominence_criterion_db,
    proximity_hz,
)

MOST_EXCESS_DB: Final = 60.0

_LEAST: Final = 1e-40
"""Mean square beside a tone that is none, Pa²."""
_CRITERIA: Final = (noise_criterion_db, prominence_criterion_db)


class JudgedTones(NamedTuple):
    """Tones at their strongest lines.

    Attributes
    ----------
    level_db : level of the tone; `SILENCE_DB` where the line belongs to a stronger one, shape (...,
        line)
    excess_db : larger excess over the criteria of both ratios, `NO_TONE_DB` to `MOST_EXCESS_DB`;
        the tone is prominent from 0, shape (..., line)
    """

    level_db: Array
    excess_db: Array


class _Bands(NamedTuple):
    """Critical bands of lines.

    Attributes
    ----------
    number : number of the lines between `LOWEST_PROMINENT_TONE_HZ` and `HIGHEST_TONE_HZ`, shape
        (tone,)
    belongs : whether a weaker tone belongs to a stronger one, shape (stronger, weaker)
    line : 1 for a line in the critical band, and those below and above, shape (3, line, tone)
    noise : part of a third octave in these bands, shape (3, band, tone)
    threshold_db : threshold of hearing, shape (tone,)
    criterion_db : criterion of tone-to-noise and prominence ratio, shape (2, tone)
    """

    number: NDArray[np.intp]
    belongs: NDArray[np.bool_]
    line: Array
    noise: Array
    threshold_db: Array
    criterion_db: Array


def judged_tones(frequency_hz: Array, square: Array, noise: Array, centre_hz: Array) -> JudgedTones:
    """Judge the prominence of tones in the noise of the same spectrum.

    A tone without noise in its critical band is not judged: any tone would be prominent.

    Parameters
    ----------
    frequency_hz : frequency of the lines, not a number where there is none, shape (line,)
    square : mean squares of the lines, shape (..., line), Pa²
    noise : mean squares of the noise in third octaves, shape (..., band), Pa²; within a band it is
        even over the logarithm of frequency
    centre_hz : exact midband frequencies, shape (band,)
    """
    bands = _bands(tuple(frequency_hz.tolist()), tuple(centre_hz.tolist()))
    lines, random = square.reshape(-1, square.shape[-1]), noise.reshape(-1, noise.shape[-1])
    tone = strongest(lines[:, bands.number], bands.belongs)
    middle, below, above = lines @ bands.line + random @ bands.noise
    of_noise = random @ bands.noise[0]
    judged = (of_noise > 0.0) & (tone > 0.0)
    beside = 0.5 * (below + above)
    ratio_db = level_of_power(
        np.stack([tone / np.maximum(of_noise, _LEAST), middle / np.maximum(beside, _LEAST)])
    )
    level_db = mean_square_level(tone, REFERENCE_PRESSURE_PA)
    over_db = np.max(ratio_db - bands.criterion_db[:, None], axis=0)
    is_audible = judged & (level_db >= bands.threshold_db)
    excess_db = np.where(is_audible, np.clip(over_db, NO_TONE_DB, MOST_EXCESS_DB), NO_TONE_DB)
    return JudgedTones(
        _at_lines(level_db, bands, square.shape, SILENCE_DB),
        _at_lines(excess_db, bands, square.shape, NO_TONE_DB),
    )


def strongest(square: Array, belongs: NDArray[np.bool_]) -> Array:
    """Add weaker lines to the stronger line to which they belong, the strongest line first.

    Parameters
    ----------
    square : mean squares, shape (spectrum, line), Pa²
    belongs : whether a weaker line belongs to a stronger one, shape (stronger, weaker)

    Returns
    -------
    mean square of each tone at its strongest line, zero at others, shape (spectrum, line)
    """
    tone = square.copy()
    coupled = np.flatnonzero((belongs | belongs.T).sum(axis=0) > 1)  # the others stay as they are
    tone[:, coupled] = _strongest(square[:, coupled], belongs[np.ix_(coupled, coupled)])
    return tone


def _strongest(square: Array, belongs: NDArray[np.bool_]) -> Array:
    """Add weaker lines to the stronger line of all lines, step by step; see `strongest`."""
    free, tone, row = square.copy(), np.zeros_like(square), np.arange(len(square))
    while free.any():
        top = free.argmax(axis=1)
        near = belongs[top]
        tone[row, top] += np.where(near, free, 0.0).sum(axis=1)
        free[near] = 0.0
    return tone


def belonging(frequency_hz: Array) -> NDArray[np.bool_]:
    """Return whether a weaker tone belongs to a stronger one, shape (stronger, weaker)."""
    rows = np.array([critical_band(tone_hz) for tone_hz in frequency_hz.tolist()]).reshape(-1, 2)
    reach = np.array([proximity_hz(tone_hz) for tone_hz in frequency_hz.tolist()])
    near = np.abs(frequency_hz - frequency_hz[:, None]) < reach[:, None]
    return np.asarray(near & (frequency_hz >= rows[:, :1]) & (frequency_hz < rows[:, 1:]))


@lru_cache(maxsize=16)
def _bands(frequency_hz: tuple[float, ...], centre_hz: tuple[float, ...]) -> _Bands:
    hertz, centre = np.array(frequency_hz), np.array(centre_hz)
    number = np.flatnonzero((hertz >= LOWEST_PROMINENT_TONE_HZ) & (hertz <= HIGHEST_TONE_HZ))
    tones = hertz[number].tolist()
    edges = np.array([_edges(tone_hz) for tone_hz in tones]).reshape(-1, 3, 2).transpose(1, 2, 0)
    cut = np.ones((3, 1, len(tones)))
    cut[1, 0] = [
        100.0 / band_below(tone_hz).width if tone_hz <= CUT_BELOW_HZ else 1.0 for tone_hz in tones
    ]
    lower, upper = edges[:, None, 0], edges[:, None, 1]
    line = (hertz[:, None] >= lower) & (hertz[:, None] < upper)
    first, last = centre[:, None] / HALF_BAND, centre[:, None] * HALF_BAND
    inner = np.log(np.minimum(last, upper) / np.maximum(first, lower))
    return _Bands(
        number,
        belonging(hertz[number]),
        cut * line,
        cut * np.clip(inner, 0.0, None) / (2.0 * np.log(HALF_BAND)),
        np.array([hearing_threshold_db(tone_hz) for tone_hz in tones]),
        np.array([[of(tone_hz) for tone_hz in tones] for of in _CRITERIA]),
    )


def _edges(frequency_hz: float) -> tuple[Edges, Edges, Edges]:
    return critical_band(frequency_hz), band_below(frequency_hz), band_above(frequency_hz)


def _at_lines(values: Array, bands: _Bands, shape: tuple[int, ...], others: float) -> Array:
    """Values of the tones at their lines, `others` at lines outside the range of tones."""
    every = np.full((len(values), shape[-1]), others)
    every[:, bands.number] = values
    return every.reshape(shape)
