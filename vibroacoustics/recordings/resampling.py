"""Samples of a channel at other times: band-limited, cubic, or by a spline of uneven times."""

from functools import cache
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray

HALF_LENGTH: Final = 32
"""Samples on either side of the band-limited kernel."""
_BETA: Final = 10.0
"""Shape of its Kaiser window: 100 dB; flat within 1e-5 up to 0.4 of the sample rate."""
_PHASES: Final = 4096
"""Positions within an interval at which the kernel is tabulated; linear between: 1e-7."""


@cache
def _kernels() -> Array:
    """Windowed sinc at tabulated fractions of an interval, shape (fraction, sample)."""
    fraction = np.arange(_PHASES + 1)[:, None] / _PHASES
    distance = fraction - np.arange(1 - HALF_LENGTH, HALF_LENGTH + 1)
    window = np.i0(_BETA * np.sqrt(np.maximum(1.0 - (distance / HALF_LENGTH) ** 2, 0.0)))
    kernels = np.sinc(distance) * window
    return np.asarray(kernels / kernels.sum(axis=1, keepdims=True))


def band_limited(samples: Array, position: Array) -> Array:
    """Values of a band-limited signal between its samples, by a windowed sinc.

    Oppenheim and Schafer, Discrete-Time Signal Processing, 3rd edition 2010, section 4.6.4.

    Parameters
    ----------
    samples : shape (time,)
    position : positions in sampling intervals, shape (position,); `HALF_LENGTH` samples or more
        from both ends

    Returns
    -------
    shape (position,), in the unit of the samples
    """
    base: IndexArray = np.floor(position).astype(np.int64)
    phase = (position - base) * _PHASES
    row: IndexArray = np.minimum(phase.astype(np.int64), _PHASES - 1)
    share = phase - row
    values = np.zeros(position.size)
    for tap, (low, high) in enumerate(zip(_kernels().T[:, :-1], _kernels().T[:, 1:], strict=True)):
        weight = low[row] + share * (high - low)[row]
        values += weight * samples[base + tap + 1 - HALF_LENGTH]
    return values


def cubic(samples: Array, position: Array) -> Array:
    """Values between samples on the cubic through the nearest four (Lagrange).

    Parameters
    ----------
    samples : shape (time,), two at least; of fewer than four on the line between two
    position : positions in sampling intervals, shape (position,), between the ends

    Returns
    -------
    shape (position,), in the unit of the samples
    """
    count = min(samples.size, 4) if samples.size != 3 else 2
    base = np.floor(position).astype(np.int64) - (count // 2 - 1)
    base = np.clip(base, 0, samples.size - count)
    offset = position - base
    values = np.zeros(position.size)
    for node in range(count):
        weight = np.ones(position.size)
        for other in range(count):
            if other != node:
                weight *= (offset - other) / (node - other)
        values += weight * samples[base + node]
    return values


def spline(time_s: Array, samples: Array, wanted_s: Array) -> Array:
    """Values at other times on the cubic spline through uneven samples.

    Parameters
    ----------
    time_s, samples : growing times, s, and their samples, shape (time,)
    wanted_s : shape (wanted,), s

    Returns
    -------
    shape (wanted,), in the unit of the samples
    """
    if time_s.size < 4:
        return np.interp(wanted_s, time_s, samples)
    from scipy.interpolate import CubicSpline  # heavy: few recordings need it

    return np.asarray(CubicSpline(time_s, samples)(wanted_s))


def prediction_error(time_s: Array, samples: Array) -> float:
    """RMS error of predicting every second sample from the others, in their unit.

    It is an upper bound of the interpolation error of a smooth signal, whose error at half the
    spacing is a sixteenth.

    Parameters
    ----------
    time_s, samples : growing times, s, and their samples, shape (time,)
    """
    last = samples.size - 1 - samples.size % 2
    if last < 1:
        return 0.0
    predicted = spline(time_s[::2], samples[::2], time_s[1:last:2])
    return float(np.sqrt(np.mean((predicted - samples[1:last:2]) ** 2))) if predicted.size else 0.0
