"""Times of tacho pulses in a sampled signal."""

from collections.abc import Callable, Iterator
from typing import Final, Literal

import numba
import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .tacho_states import TachoStates

_HYSTERESIS: Final = 0.4
"""Of the swing: noise has to cross the middle 40 % to make a pulse, and a pulse of two or three
samples, which a converter's filter rounds, still reaches 70 % of the swing."""


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
    if signal.ndim != 1 or signal.size == 0:
        raise ParameterError(f"tacho: needs samples of one channel, got shape {signal.shape}")
    once = (np.asarray(signal, dtype=float),)
    return pulse_times_of(
        lambda: iter(once), signal.size, sample_rate_hz, edge, threshold, hysteresis
    )


def pulse_times_of(
    blocks: Callable[[], Iterator[Array]],
    samples: int,
    sample_rate_hz: float,
    edge: Literal["rising", "falling"] = "rising",
    threshold: float | None = None,
    hysteresis: float | None = None,
) -> Array:
    """Times of the pulses of a tacho that comes in blocks; see `pulse_times`.

    Parameters
    ----------
    blocks : starts over with the channel's blocks, each of shape (time,): they are read twice
    samples : of all blocks
    sample_rate_hz, edge, threshold, hysteresis : of `pulse_times`
    """
    states = TachoStates(samples)
    for block in blocks():
        states.add(block)
    low, high = states.levels()
    middle = 0.5 * (low + high) if threshold is None else threshold
    band = _HYSTERESIS * (high - low) if hysteresis is None else hysteresis
    sign = 1.0 if edge == "rising" else -1.0
    levels = sign * middle - 0.5 * band, sign * middle, sign * middle + 0.5 * band
    state, first, crossings = np.array([np.nan, 0.0, 0.0]), 0, []
    for block in blocks():
        crossings.append(_crossings(block, first, sign, levels, state))
        first += block.size
    times = np.concatenate(crossings) / sample_rate_hz
    if times.size == 0:
        raise ParameterError(
            f"tacho: no {edge} edge in {samples} samples; the signal goes from "
            f"{states.lowest:.4g} to {states.highest:.4g}, the threshold is {middle:.4g} "
            f"with a hysteresis of {band:.4g}"
        )
    return np.asarray(times)


@numba.njit(cache=True, nogil=True)
def _crossings(
    signal: Array, first: int, sign: float, levels: tuple[float, float, float], state: Array
) -> Array:
    """Upward crossings of the middle in samples, one for each way from lower to upper.

    Parameters
    ----------
    signal : the next samples; times `sign` they are what goes upward
    first : number of its first sample
    sign : 1 or -1
    levels : lower, middle, upper
    state : the sample before, not a number at the start; 1 where the signal has been below the
        lower level since the last crossing; the last crossing of the middle. It is changed
    """
    lower, middle, upper = levels
    crossings = np.empty(signal.size // 2 + 1)
    count = 0
    before, armed, crossing = state[0], state[1] > 0.0, state[2]
    for k in range(signal.size):
        after = sign * signal[k]
        if armed and before < middle <= after:
            crossing = first + k - 1 + (middle - before) / (after - before)
        if armed and after >= upper:
            crossings[count] = crossing
            count += 1
            armed = False
        elif after <= lower:
            armed = True
        before = after
    state[:] = (before, 1.0 if armed else 0.0, crossing)
    return crossings[:count].copy()
