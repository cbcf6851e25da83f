"""Drift of the lines of a signal: whether it is a run-up or run-down."""

from itertools import pairwise
from typing import Final

import numpy as np
from scipy.ndimage import median_filter
from scipy.signal import get_window

from ..base.arrays import Array

_BLOCK_S: Final = 0.5
_PAIRS: Final = 30
"""Pairs of spectra that are compared, over the whole signal."""
_PER_OCTAVE: Final = 48
_RANGE_HZ: Final = (150.0, 4000.0)
_MOST: Final = 16
"""Largest shift between two spectra, in steps of the logarithm of frequency."""
_LEAST_OCTAVES: Final = 0.25
_AGREEING: Final = 0.8
"""Share of the pairs that shift one way in a run-up (assumed)."""
_ALIKE: Final = 0.5
"""Correlation above which two spectra hold the same lines; spectra of noise have less (assumed)."""


def drift_octaves(signal: Array, sample_rate_hz: float) -> float:
    """Estimate by how many octaves all lines rise or fall together; 0 of a steady signal.

    Spectra over the logarithm of frequency, one after the other, are shifted until they correlate
    best. A drift counts from a quarter of an octave on, where four of five shifts agree in sign.

    Parameters
    ----------
    signal : shape (sample,)
    sample_rate_hz : sample rate, Hz
    """
    length = round(_BLOCK_S * sample_rate_hz)
    highest = min(_RANGE_HZ[1], 0.45 * sample_rate_hz)
    count = min(_PAIRS, signal.size // length - 1)
    if count < 4 or highest < 2.0 * _RANGE_HZ[0]:
        return 0.0
    steps = int(_PER_OCTAVE * np.log2(highest / _RANGE_HZ[0]))
    hertz = _RANGE_HZ[0] * 2.0 ** (np.arange(steps) / _PER_OCTAVE)
    begins = np.linspace(0, signal.size - length, count + 1).astype(int)
    window = get_window("hann", length)
    shapes = []
    for begin in begins:
        spectrum = np.abs(np.fft.rfft(window * signal[begin : begin + length])) ** 2
        level = np.log(np.interp(hertz, np.fft.rfftfreq(length, 1.0 / sample_rate_hz), spectrum)
                       + 1e-12 * spectrum.max() + np.finfo(float).tiny)  # fmt: skip
        shapes.append(np.maximum(level - median_filter(level, _PER_OCTAVE // 2 + 1), 0.0))
    shifts = np.array([_shift(*pair) for pair in pairwise(shapes)])
    octaves = float(shifts.sum()) / _PER_OCTAVE
    agreeing = float(np.mean(np.sign(shifts) == np.sign(octaves)))
    return octaves if abs(octaves) >= _LEAST_OCTAVES and agreeing >= _AGREEING else 0.0


def _shift(first: Array, second: Array) -> int:
    """Steps by which the lines of the second spectrum are above those of the first; 0 of noise."""
    inner = first[_MOST:-_MOST]
    parts = np.lib.stride_tricks.sliding_window_view(second, inner.size)
    size = np.linalg.norm(inner) * np.linalg.norm(parts, axis=1)
    likeness = np.divide(parts @ inner, size, out=np.zeros(len(parts)), where=size > 0.0)
    best = int(np.argmax(likeness))
    return best - _MOST if likeness[best] >= _ALIKE else 0
