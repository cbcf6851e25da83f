"""Hits of a hammer in the record of its force: where they are, and which are double."""

from typing import Final, NamedTuple

import numpy as np
from scipy import signal

from ..base.arrays import Array, IndexArray
from ..base.errors import ParameterError

LEAST_HIT: Final = 0.1
"""Least force of a hit, share of the largest one of the record; assumed."""
LEAST_SECOND: Final = 0.05
"""Least force of a second hit, share of the first one; assumed."""
DEVIATIONS: Final = 5.0
"""Standard deviations of the noise that a pulse exceeds: one false one in 3 million values."""
LONGEST_BOUNCE_S: Final = 0.2
"""Pulses that follow each other faster are one hit; assumed."""
BEFORE, AFTER = 4.0, 6.0
"""Begin of a block and end of its force, from the peak, widths at half of the peak; assumed."""
SPARE: Final = 0.9
"""Length of a block over the shortest time between hits."""
_OF_MEDIAN: Final = 1.4826
"""Standard deviation over the median deviation of a normal distribution."""


class Pulses(NamedTuple):
    """Pulses of a force.

    Attributes
    ----------
    sample : number of the sample at each peak, shape (pulse,)
    height_n : height of each peak, smoothed over its width, shape (pulse,)
    width : width at half of the highest peak, samples
    is_reversed : whether they pull, which no hammer does
    """

    sample: IndexArray
    height_n: Array
    width: int
    is_reversed: bool


class Hit(NamedTuple):
    """Hit in a record.

    Attributes
    ----------
    peak : number of the sample at its peak
    first : number of the first sample of its block
    force_n : height of its peak
    second : force of the second pulse in its block over that of the first; 0 without
    """

    peak: int
    first: int
    force_n: float
    second: float


def pulses(force_n: Array) -> Pulses:
    """Find the pulses of a force: peaks of its mean over the width of the highest one.

    The mean over the width of a pulse keeps its height and lowers white noise by the root of that
    width. A pulse exceeds `DEVIATIONS` of what noise is left, and falls by as much on both sides.

    Parameters
    ----------
    force_n : shape (time,)

    Raises
    ------
    ParameterError
        The force is constant.

    Examples
    --------
    >>> force = np.zeros(1000)
    >>> force[300:321] = 50.0 * np.sin(np.pi * np.arange(21) / 20.0)
    >>> detected = pulses(force)
    >>> detected.sample.tolist(), detected.width
    ([310], 13)
    """
    centred = force_n - np.median(force_n)
    highest = int(np.argmax(np.abs(centred)))
    if centred[highest] == 0.0:
        raise ParameterError("force: is constant")
    is_reversed = bool(centred[highest] < 0.0)
    pushes = -centred if is_reversed else centred
    width = _width(pushes, highest)
    window = signal.windows.hann(2 * (width // 2) + 3)[1:-1]
    smooth = signal.oaconvolve(pushes, window / window.sum(), mode="same")
    noise_n = _OF_MEDIAN * float(np.median(np.abs(smooth - np.median(smooth))))
    least_n = max(DEVIATIONS * noise_n, LEAST_SECOND * LEAST_HIT * smooth.max())
    peaks, _ = signal.find_peaks(smooth, height=least_n, prominence=least_n)
    return Pulses(peaks, smooth[peaks], width, is_reversed)


def _width(pushes: Array, highest: int) -> int:
    """Width of the highest pulse at half of its height, samples."""
    below = pushes < 0.5 * pushes[highest]
    before, after = below[:highest][::-1], below[highest:]
    rising = int(np.argmax(before)) if before.any() else before.size
    falling = int(np.argmax(after)) if after.any() else after.size
    return max(rising + falling, 1)


def hits_of(detected: Pulses, block: int) -> list[Hit]:
    """Hits with the second pulses in their blocks.

    Parameters
    ----------
    detected : pulses of a record
    block : length of a block, samples
    """
    hits: list[Hit] = []
    for first in _leading(detected, block):
        peak, height_n = int(detected.sample[first]), float(detected.height_n[first])
        begin = peak - round(BEFORE * detected.width)
        later = (detected.sample > peak) & (detected.sample < begin + block)
        second = float(np.max(detected.height_n[later], initial=0.0)) / height_n
        hits.append(Hit(peak, begin, height_n, second if second >= LEAST_SECOND else 0.0))
    return hits


def _leading(detected: Pulses, block: int) -> list[int]:
    """Numbers of the pulses that begin a hit: none before is within a block."""
    leading: list[int] = []
    high = np.flatnonzero(detected.height_n >= LEAST_HIT * detected.height_n.max(initial=0.0))
    for number in high.tolist():
        if not leading or detected.sample[number] - detected.sample[leading[-1]] >= block:
            leading.append(number)
    return leading


def longest_block(detected: Pulses, samples: int, sample_rate_hz: float) -> int:
    """Length that blocks of the hits of a record can have, samples.

    Parameters
    ----------
    detected : its pulses
    samples : number of its samples
    sample_rate_hz : its sample rate
    """
    peaks = detected.sample[_leading(detected, round(LONGEST_BOUNCE_S * sample_rate_hz))]
    if not peaks.size:
        return 0
    to_end = samples - int(peaks[-1]) + round(BEFORE * detected.width)
    gaps: list[int] = [int(SPARE * gap) for gap in np.diff(peaks)]
    lengths = [*gaps, to_end]
    return min(length for length in lengths if 2 * length > np.median(gaps or lengths))


def windowed_force(force_n: Array, peak: int, width: int) -> Array:
    """Force of one hit: less its offset, and zero after the pulse, with half a cosine between.

    Noise after the pulse is no force on the structure (force window of ISO 7626-5).

    Parameters
    ----------
    force_n : block of a record, shape (time,)
    peak : number of the sample at the peak
    width : width of the pulse at half of its height, samples
    """
    distance = (np.arange(force_n.size) - peak) / width
    fall = np.clip((distance - AFTER + 2.0) / 2.0, 0.0, 1.0)
    window = np.where(distance < -BEFORE, 0.0, 0.5 + 0.5 * np.cos(np.pi * fall))
    return np.asarray((force_n - np.median(force_n)) * window)
