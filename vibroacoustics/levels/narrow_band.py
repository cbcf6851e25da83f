"""A narrow-band spectrum taken apart: lines at shaft orders, and the rest in third octaves."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array, IndexArray
from .bands import Band

SPEED_ERROR: Final = 0.002
"""Share by which the speed may be off: so much wider a line is looked for."""
LEAST_FLOOR_LINES: Final = 2
"""Lines on either side of a line, from which the noise under it is estimated."""
MOST_FLOOR_LINES: Final = 4


@dataclass(frozen=True)
class TakenApart:
    """Mean squares of tones and of all that is none.

    Attributes
    ----------
    order : mean square of each tone, shape (order,); not a number where lines are too close to
        separate it from its neighbours
    band : mean square of each band without the tones, shape (band,); not a number where the
        spectrum does not cover a band
    """

    order: Array
    band: Array


def taken_apart(
    frequency_hz: Array,
    mean_square: Array,
    lobe_lines: float,
    noise_bandwidth_lines: float,
    tone_hz: Array,
    bands: Sequence[Band],
) -> TakenApart:
    """Tones and third octaves of a spectrum of a windowed signal.

    A tone is what its window's main lobe, and as much again on either side where the next tone
    leaves room, holds above the mean of the lines beside it; these stand for what is no tone
    there. Sums of lines are divided by the window's noise bandwidth (Heinzel, Rüdiger and Schilling
    2002, equation 24). A line that the edge of a band cuts is shared.

    Parameters
    ----------
    frequency_hz : even and rising, shape (line,)
    mean_square : mean square of a tone on the line, shape (line,)
    lobe_lines : half the window's main lobe
    noise_bandwidth_lines : noise bandwidth of the window, lines
    tone_hz : rising, shape (order,)
    bands : bands of the result
    """
    step = float(frequency_hz[1] - frequency_hz[0])
    noise = np.array(mean_square, dtype=float)
    half = [_half_width(tone, tone_hz, lobe_lines, step) for tone in tone_hz.tolist()]
    tonal = np.zeros(noise.size, dtype=bool)
    for tone, width in zip(tone_hz.tolist(), half, strict=True):
        tonal |= np.abs(frequency_hz - tone) <= width * step
    power = np.full(tone_hz.size, np.nan)
    for number, (tone, width) in enumerate(zip(tone_hz.tolist(), half, strict=True)):
        lines = np.abs(frequency_hz - tone) <= width * step
        floor = _floor(mean_square, np.flatnonzero(lines), tonal)
        if width == 0.0 or floor is None:
            continue
        power[number] = max(float(np.sum(mean_square[lines] - floor)), 0.0)
        noise[lines] = floor
    share = _shares(frequency_hz, step, bands)
    return TakenApart(
        power / noise_bandwidth_lines, np.asarray(share @ noise) / noise_bandwidth_lines
    )


def _half_width(tone: float, tone_hz: Array, lobe_lines: float, step: float) -> float:
    """Half the lines that are a tone's; none where its neighbours leave no room for the floor."""
    apart = np.abs(tone_hz - tone)
    room = float(np.min(apart[apart > 0.0], initial=tone)) / step
    slack = SPEED_ERROR * tone / step
    for half in (2.0 * lobe_lines + slack, lobe_lines + slack):
        if room >= 2.0 * half + 2.0 * LEAST_FLOOR_LINES:
            return half
    return 0.0


def _floor(mean_square: Array, lines: IndexArray, tonal: NDArray[np.bool_]) -> float | None:
    """Mean of the nearest lines on either side that are no tone's; none where there are too few."""
    if not lines.size:
        return None
    below = np.flatnonzero(~tonal[: lines[0]])[-MOST_FLOOR_LINES:]
    above = lines[-1] + 1 + np.flatnonzero(~tonal[lines[-1] + 1 :])[:MOST_FLOOR_LINES]
    if above.size < LEAST_FLOOR_LINES:
        return None
    return float(np.mean(mean_square[np.concatenate([below, above])]))


def _shares(frequency_hz: Array, step: float, bands: Sequence[Band]) -> Array:
    """Share of each line in each band, (band, line); not a number where a band is not covered."""
    lower = np.array([[band.lower_hz] for band in bands])
    upper = np.array([[band.upper_hz] for band in bands])
    start, end = frequency_hz - 0.5 * step, frequency_hz + 0.5 * step
    shared = np.clip((np.minimum(upper, end) - np.maximum(lower, start)) / step, 0.0, 1.0)
    covered = (lower >= start[0]) & (upper <= end[-1]) & (upper - lower >= step)
    return np.where(covered, shared, np.nan)
