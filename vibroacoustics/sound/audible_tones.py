"""Audible tones of a narrow-band spectrum (ISO/PAS 20065)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array, IndexArray
from ..base.constants import LOWEST_AUDIBLE_TONE_HZ
from ..base.decibel import (
    energy_sum,
    level_of_power,
    power_of_level,
)
from .audibility import (
    RESOLVED_BELOW_HZ,
    TONE_MARGIN_DB,
    audibility_db,
    critical_edges_hz,
    extended_uncertainty_db,
)
from .critical_bands import proximity_hz

STEP_HZ: Final = 2.7
"""Distance of the lines; the standard allows 1.9 to 4.0 Hz."""
HIGHEST_HZ: Final = 11220.0
"""Highest frequency of a tone: upper edge of the third octave of 10 kHz."""
_HANN_DB: Final = float(level_of_power(1.5))
"""Level by which the Hann window raises a sum of lines: its noise is 1.5 lines wide."""
_PEAK_DROP_DB: Final = 10.0
_SETTLED_DB: Final = 0.005
FEWEST_LINES: Final = 5
"""Lines of noise on either side of a tone at least (annex D)."""
_STEEPNESS_DB: Final = 24.0
"""Least steepness of both flanks of a tone, dB an octave (equations 10 and 11)."""


@dataclass(frozen=True)
class AudibleTone:
    """Audible tone, or tones of one critical band together.

    Attributes
    ----------
    frequency_hz : frequency of the tone, or of the most audible of the tones
    level_db : A-weighted level of the tone or the tones
    noise_line_db : mean A-weighted level of a line of the noise around it
    audibility_db : level over the masked threshold
    uncertainty_db : extended uncertainty of the audibility, 90 % on both sides
    count : number of tones
    """

    frequency_hz: float
    level_db: float
    noise_line_db: float
    audibility_db: float
    uncertainty_db: float
    count: int = 1


@dataclass(frozen=True)
class _Peak:
    """Distinct tone of a spectrum: its lines `first` to `last`, and the noise around it."""

    first: int
    last: int
    tone: AudibleTone
    noise_db: Array


def audible_tones(level_db: Array, frequency_hz: Array) -> list[AudibleTone]:
    """Find the audible tones of a narrow-band spectrum, and those that one critical band joins.

    A tone is a peak at least 6 dB over the mean noise line, narrow and steep enough to be heard
    as a tone (clause 5.3.4). Audible tones of one critical band also count together (equation
    17), but for two below 1 kHz that are heard apart (equations 18 and 19).

    Parameters
    ----------
    level_db : A-weighted levels of lines of a Hann window, shape (line,), dB
    frequency_hz : their frequencies, equally spaced, shape (line,), Hz

    Returns
    -------
    single tones by frequency, then tones of one critical band together
    """
    peaks = [peak for peak in _peaks(level_db, frequency_hz) if peak.tone.audibility_db > 0.0]
    return [peak.tone for peak in peaks] + _joined(peaks, level_db, frequency_hz)


def mean_noise_lines(
    level_db: Array, frequency_hz: Array, tone: IndexArray
) -> tuple[Array, NDArray[np.bool_], IndexArray]:
    """Return the mean level of a line of the noise around tones (equation 6, annex D).

    Lines more than 6 dB over the mean are dropped until it moves by less than 0.005 dB, or fewer
    than five lines would be left on a side of the tone. The line of the tone never counts.

    Parameters
    ----------
    level_db : A-weighted levels of lines of a Hann window, shape (line,), dB
    frequency_hz : their frequencies, equally spaced, shape (line,), Hz
    tone : line of each tone, shape (tone,)

    Returns
    -------
    mean level, shape (tone,), dB; which of the lines around are noise, shape (tone, around); the
    numbers of these lines, shape (tone, around)
    """
    lower, upper = critical_edges_hz(frequency_hz[tone])
    first = np.searchsorted(frequency_hz, lower)
    last = np.searchsorted(frequency_hz, upper, side="right")
    line = first[:, None] + np.arange(np.max(last - first))
    is_noise = (line < last[:, None]) & (line != tone[:, None])
    line = np.minimum(line, frequency_hz.size - 1)
    around_db, is_left = level_db[line], line < tone[:, None]
    power = power_of_level(around_db)
    mean_db = _mean_db(power, is_noise)
    pending = np.arange(tone.size)
    while pending.size:
        limit_db = mean_db[pending, None] + TONE_MARGIN_DB
        kept = is_noise[pending] & (around_db[pending] <= limit_db)
        below = np.sum(kept & is_left[pending], axis=1)
        enough = np.minimum(below, np.sum(kept, axis=1) - below) >= FEWEST_LINES
        changed = enough & np.any(kept != is_noise[pending], axis=1)
        pending, kept = pending[changed], kept[changed]
        is_noise[pending] = kept
        new_db = _mean_db(power[pending], kept)
        is_unsettled = np.abs(new_db - mean_db[pending]) > _SETTLED_DB
        mean_db[pending] = new_db
        pending = pending[is_unsettled]
    return mean_db, is_noise, line


def _mean_db(power: Array, is_noise: NDArray[np.bool_]) -> Array:
    total, count = np.sum(np.where(is_noise, power, 0.0), axis=1), np.sum(is_noise, axis=1)
    return np.where(count > 0, level_of_power(total / np.maximum(count, 1)) - _HANN_DB, np.inf)


def _peaks(level_db: Array, frequency_hz: Array) -> list[_Peak]:
    """Find distinct tones: local maxima over the noise, each the strongest of its run of lines."""
    highest = min(HIGHEST_HZ, float(frequency_hz[-1]))
    before, after = level_db[:-2], level_db[2:]
    is_peak = (level_db[1:-1] >= before) & (level_db[1:-1] >= after)
    maximum = 1 + np.flatnonzero(is_peak)
    maximum = maximum[
        (frequency_hz[maximum] >= LOWEST_AUDIBLE_TONE_HZ) & (frequency_hz[maximum] <= highest)
    ]
    if not maximum.size:
        return []
    mean_db, is_noise, line = mean_noise_lines(level_db, frequency_hz, maximum)
    tones: list[_Peak] = []
    end = 0
    for row in np.flatnonzero(level_db[maximum] > mean_db + TONE_MARGIN_DB):
        if maximum[row] < end:
            continue
        run = maximum[row] + np.flatnonzero(
            level_db[maximum[row] :] <= mean_db[row] + TONE_MARGIN_DB
        )
        end = int(run[0]) if run.size else level_db.size
        within = row + np.arange(np.searchsorted(maximum[row:], end))
        top = int(within[np.argmax(level_db[maximum[within]])])
        peak = _peak(level_db, frequency_hz, int(maximum[top]), float(mean_db[top]),
                     level_db[line[top][is_noise[top]]])  # fmt: skip
        if peak:
            tones.append(peak)
    return tones


def _peak(
    level_db: Array, frequency_hz: Array, top: int, mean_db: float, noise_db: Array
) -> _Peak | None:
    """Tone around a line, if it is distinct."""
    least_db = max(mean_db + TONE_MARGIN_DB, level_db[top] - _PEAK_DROP_DB)
    is_low = level_db <= least_db
    first = top - int(np.argmax(is_low[top::-1])) + 1 if is_low[:top].any() else 0
    last = top + int(np.argmax(is_low[top:])) - 1 if is_low[top:].any() else level_db.size - 1
    if level_db[top] <= least_db or not _is_distinct(level_db, frequency_hz, top, first, last):
        return None
    hertz, step_hz = float(frequency_hz[top]), float(frequency_hz[1] - frequency_hz[0])
    lines_db = level_db[first : last + 1]
    tone_db = _tone_db(lines_db)
    heard_db = float(
        audibility_db(np.array(tone_db), np.array(mean_db), frequency_hz[top], step_hz)
    )
    spread_db = extended_uncertainty_db(lines_db, noise_db, hertz, step_hz)
    tone = AudibleTone(hertz, tone_db, mean_db, heard_db, spread_db)
    return _Peak(first, last, tone, noise_db)


def _tone_db(lines_db: Array) -> float:
    """Level of a tone: sum of its lines less the width of the window (equations 7 and 8)."""
    return float(energy_sum(lines_db, 0)) - (_HANN_DB if lines_db.size > 1 else 0.0)


def _is_distinct(level_db: Array, frequency_hz: Array, top: int, first: int, last: int) -> bool:
    """Whether a tone is narrow and both flanks are steep (clause 5.3.4).

    The steepness is that of DIN 45681, f/√2 on both sides; ISO/PAS 20065 prints f/2 and f.
    """
    hertz, step_hz = frequency_hz[top], frequency_hz[1] - frequency_hz[0]
    if (last - first + 1) * step_hz > 26.0 * (1.0 + 0.001 * hertz):
        return False
    beside = [line for line in (first - 1, last + 1) if 0 <= line < level_db.size]
    drop_db = level_db[top] - level_db[beside]
    distance = np.sqrt(2.0) * np.abs(frequency_hz[beside] - hertz) / hertz
    return bool(np.all(drop_db >= _STEEPNESS_DB * distance))


def _joined(peaks: Sequence[_Peak], level_db: Array, frequency_hz: Array) -> list[AudibleTone]:
    """Join the audible tones of one critical band, that of the most audible of them."""
    hertz = np.array([peak.tone.frequency_hz for peak in peaks])
    heard_db = np.array([peak.tone.audibility_db for peak in peaks])
    joined = []
    for number, peak in enumerate(peaks):
        lower, upper = critical_edges_hz(hertz[number])
        members = np.flatnonzero((hertz >= lower) & (hertz <= upper))
        if members.size < 2 or number != members[np.argmax(heard_db[members])]:
            continue
        if members.size == 2 and heard_apart(hertz[members], hertz[number]):
            continue
        joined.append(_together(peak, [peaks[m] for m in members], level_db, frequency_hz))
    return joined


def heard_apart(pair_hz: Array, more_audible_hz: float) -> bool:
    """Return whether two tones of one critical band are heard apart (equations 18 and 19)."""
    distance = abs(float(pair_hz[1] - pair_hz[0]))
    return bool(
        np.all(pair_hz < RESOLVED_BELOW_HZ)
        and distance > float(proximity_hz(np.array(more_audible_hz)))
    )


def _together(
    decisive: _Peak, members: Sequence[_Peak], level_db: Array, frequency_hz: Array
) -> AudibleTone:
    """Rate tones as one at the frequency of the most audible (equation 17)."""
    tone = decisive.tone
    step_hz = float(frequency_hz[1] - frequency_hz[0])
    lines = np.unique(np.concatenate([np.arange(p.first, p.last + 1) for p in members]))
    together_db = _tone_db(level_db[lines])
    tones_db = np.array([member.tone.level_db for member in members])
    return AudibleTone(
        tone.frequency_hz,
        together_db,
        tone.noise_line_db,
        tone.audibility_db + together_db - tone.level_db,
        extended_uncertainty_db(tones_db, decisive.noise_db, tone.frequency_hz, step_hz),
        len(members),
    )
