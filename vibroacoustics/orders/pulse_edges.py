"""Times of tacho pulses in a sampled signal."""

from typing import Final, Literal

import numba
import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError

_HYSTERESIS: Final = 0.4
"""Of the swing: noise has to cross the middle 40 % to make a pulse, and a pulse of two or three
samples, which a converter's filter rounds, still reaches 70 % of the swing."""
_BLOCKS: Final = 1000
_EXTREME_BLOCK: Final = 3
"""The highest and lowest levels are the third extreme of those of the blocks, so that spikes in two
blocks do not count; three pulses are the fewest that a speed can be told from."""
_TWO_STATES: Final = 0.3
"""Share of the extremes' swing that lies between the two states' medians. White noise has 0.14, a
pulse with noise of 0.2 of the swing 0.34; a pulse to both sides of a rest has about 0."""


def pulse_times(
    signal: Array,
    sample_rate_hz: float,
    edge: Literal["rising", "falling"] = "rising",
    threshold: float | None = None,
    hysteresis: float | None = None,
) -> Array:
    """Times at which a tacho signal crosses its threshold, between the samples.

    A pulse counts when the signal has come from below the hysteresis band to above it; its time is
    the last crossing of the threshold on that way, by linear interpolation. The threshold is the
    middle between the two states of the signal (50 % reference level, IEEE Std 181-2011).

    Parameters
    ----------
    signal : shape (time,), in any unit
    sample_rate_hz : samples per second
    edge : the edge that marks the angle; that of an inductive pickup is its zero crossing
    threshold : level to cross, in the signal's unit; from the signal where not given
    hysteresis : full width of the band around the threshold, in the signal's unit; 40 % of the
        swing where not given. A pickup whose amplitude grows with speed needs both.

    Returns
    -------
    shape (pulses,), s from the first sample

    Raises
    ------
    ParameterError
        The signal is empty, not finite, constant, or has no pulse.
    """
    _check_signal(signal)
    signal = np.asarray(signal, dtype=float)
    low, high = _levels(signal)
    middle = 0.5 * (low + high) if threshold is None else threshold
    band = _HYSTERESIS * (high - low) if hysteresis is None else hysteresis
    sign = 1.0 if edge == "rising" else -1.0
    upward, at = sign * signal, sign * middle
    crossings: Array = _crossings(upward, at - 0.5 * band, at, at + 0.5 * band)
    if crossings.size == 0:
        raise ParameterError(
            f"tacho: no {edge} edge in {signal.size} samples; the signal goes from "
            f"{np.min(signal):.4g} to {np.max(signal):.4g}, the threshold is {middle:.4g} "
            f"with a hysteresis of {band:.4g}"
        )
    return crossings / sample_rate_hz


def _check_signal(signal: Array) -> None:
    if signal.ndim != 1 or signal.size == 0:
        raise ParameterError(f"tacho: needs samples of one channel, got shape {signal.shape}")
    if not np.all(np.isfinite(signal)):
        raise ParameterError(
            f"tacho: {np.count_nonzero(~np.isfinite(signal))} of {signal.size} samples are not "
            "finite numbers"
        )
    if np.ptp(signal) == 0.0:
        raise ParameterError(f"tacho: no pulses: the signal is constant at {signal[0]:.4g}")


def _levels(signal: Array) -> tuple[float, float]:
    """Low and high state, however short the pulses are."""
    starts = np.arange(0, signal.size, -(-signal.size // _BLOCKS))
    nth = min(_EXTREME_BLOCK, starts.size)
    bottom = float(np.sort(np.minimum.reduceat(signal, starts))[nth - 1])
    top = float(np.sort(np.maximum.reduceat(signal, starts))[-nth])
    above = signal >= 0.5 * (bottom + top)
    if top <= bottom or above.all() or not above.any():
        return float(signal.min()), float(signal.max())
    low, high = float(np.median(signal[~above])), float(np.median(signal[above]))
    return (low, high) if high - low > _TWO_STATES * (top - bottom) else (bottom, top)


@numba.njit(cache=True, nogil=True)
def _crossings(signal: Array, lower: float, middle: float, upper: float) -> Array:
    """Upward crossings of the middle in samples, one for each way from lower to upper."""
    crossings = np.empty(signal.size // 2 + 1)
    count = 0
    armed = signal[0] <= lower
    crossing = 0.0
    for k in range(1, signal.size):
        before, after = signal[k - 1], signal[k]
        if armed and before < middle <= after:
            crossing = k - 1 + (middle - before) / (after - before)
        if armed and after >= upper:
            crossings[count] = crossing
            count += 1
            armed = False
        elif after <= lower:
            armed = True
    return crossings[:count].copy()
