"""Times of tacho pulses in a sampled signal."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

import numba
import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import Edge
from .pulse_heights import EVEN_HEIGHT, Heights, continued, end_is_silent, heights_of
from .tacho_states import TachoStates

Blocks = Callable[[], Iterator[Array]]

_HYSTERESIS: Final = 0.4
"""Share of the swing: noise has to cross the middle 40 % to make a pulse, and a pulse of two or
three samples, which a converter's filter rounds, still reaches 70 % of the swing."""
_STEEPER: Final = 0.5
"""Time of the falling edge over that of the rising one, below which the falling one is taken."""
_BLOCK_SAMPLES: Final = 2**16
"""Samples of an array that are worked on at a time: half a MiB."""
_ROUNDS: Final = 5
"""Rounds in which the threshold follows the height: each reaches pulses of a fifth of the last
height."""


@dataclass(frozen=True)
class TachoPulses:
    """Pulses of a tacho.

    Attributes
    ----------
    time_s : from the first sample, shape (pulse,)
    edge : the edge that was taken
    """

    time_s: Array
    edge: Edge


def pulse_times(
    signal: Array,
    sample_rate_hz: float,
    edge: Edge | None = None,
    threshold: float | None = None,
    hysteresis: float | None = None,
) -> Array:
    """Times at which a tacho signal crosses its threshold, between the samples.

    A pulse counts when the signal has come from below the hysteresis band to above it; its time is
    the last crossing of the threshold on that way, by linear interpolation. The threshold is the
    middle between the two states of the signal (50 % reference level, IEEE Std 181-2011). Where the
    height of the pulses changes, as an inductive pickup's does with the speed, threshold and band
    follow it.

    Parameters
    ----------
    signal : shape (time,), in any unit
    sample_rate_hz : samples per second
    edge : the edge that marks the angle; where not given the first one of a pulse, rising or, of
        inverted pulses, falling; of pulses to both sides of a rest the steeper one, which is the
        zero crossing of an inductive pickup
    threshold : level to cross, in the signal's unit; from the signal where not given
    hysteresis : full width of the band around the threshold, in the signal's unit; 40 % of the
        swing where not given

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

    def blocks() -> Iterator[Array]:
        for first in range(0, signal.size, _BLOCK_SAMPLES):
            yield np.asarray(signal[first : first + _BLOCK_SAMPLES], dtype=float)

    return pulses_of(blocks, signal.size, sample_rate_hz, edge, threshold, hysteresis).time_s


def pulses_of(
    blocks: Blocks,
    samples: int,
    sample_rate_hz: float,
    edge: Edge | None = None,
    threshold: float | None = None,
    hysteresis: float | None = None,
) -> TachoPulses:
    """Pulses of a tacho that comes in blocks; see `pulse_times`.

    Parameters
    ----------
    blocks : starts over with the channel's blocks, each of shape (time,): they are read twice, and
        again where the height of the pulses changes
    samples : number of samples of all blocks
    sample_rate_hz, edge, threshold, hysteresis : see `pulse_times`
    """
    states = TachoStates(samples)
    for block in blocks():
        states.add(block)
    low, high, are_two_states = states.levels()
    levels = _Levels(
        idle=states.idle(),
        middle=0.5 * (low + high) if threshold is None else threshold,
        band=_HYSTERESIS * (high - low) if hysteresis is None else hysteresis,
        middle_follows=threshold is None,
        band_follows=hysteresis is None,
    )
    if edge is None and are_two_states:
        edge = "falling" if states.is_inverted() else "rising"
    if edge is None:
        edge = _steeper(blocks, levels)
    pulses = _followed(blocks, samples, edge, levels, not are_two_states)
    if pulses.size == 0:
        raise ParameterError(
            f"tacho: no {edge} edge in {samples} samples; the signal goes from "
            f"{states.lowest:.4g} to {states.highest:.4g}, the threshold is {levels.middle:.4g} "
            f"with a hysteresis of {levels.band:.4g}"
        )
    return TachoPulses(pulses / sample_rate_hz, edge)


class _Levels(NamedTuple):
    """Threshold and band around it at full height, the level at rest, what follows the height."""

    idle: float
    middle: float
    band: float
    middle_follows: bool
    band_follows: bool


def _steeper(blocks: Blocks, levels: _Levels) -> Edge:
    """The edge that takes less time."""
    rising, falling = (_detected(blocks, edge, levels, None)[2] for edge in ("rising", "falling"))
    if rising.size == 0 or falling.size == 0:
        return "rising" if rising.size else "falling"
    is_steeper = float(np.median(falling)) < _STEEPER * float(np.median(rising))
    return "falling" if is_steeper else "rising"


def _followed(blocks: Blocks, samples: int, edge: Edge, levels: _Levels, has_lobes: bool) -> Array:
    """Pulses in samples, with a threshold that follows their height where that changes."""
    pulses, swings, _ = _detected(blocks, edge, levels, None)
    if not (levels.middle_follows or levels.band_follows):
        return pulses
    for _ in range(_ROUNDS):
        heights = heights_of(pulses, swings)
        if heights is None:
            return pulses
        is_even = heights.least >= EVEN_HEIGHT
        if is_even and not end_is_silent(pulses, samples):
            return pulses
        before = pulses
        crossings, swings, _ = _detected(blocks, edge, levels, heights)
        pulses, swings = continued(before, crossings, swings, has_lobes)
        if pulses.size == before.size:
            return before if is_even else pulses
    return pulses


def _detected(
    blocks: Blocks, edge: Edge, levels: _Levels, heights: Heights | None
) -> tuple[Array, Array, Array]:
    """Crossings in samples, swings before, between and behind them, samples that each edge takes.

    Parameters
    ----------
    blocks, edge, levels : see above
    heights : relative, which the levels follow; None where they are 1
    """
    sign = 1.0 if edge == "rising" else -1.0
    state, first, parts = np.array([np.nan, 0.0, 0.0, -np.inf, np.inf, 0.0]), 0, []
    for block in blocks():
        height = np.ones(1) if heights is None else heights.height_at(first, block.size)
        middle = levels.idle + (levels.middle - levels.idle) * height
        half = 0.5 * levels.band * (height if levels.band_follows else np.ones(height.size))
        middle = middle if levels.middle_follows else np.full(height.size, levels.middle)
        parts.append(_crossings(block, first, sign, sign * middle, half, state))
        first += block.size
    crossings, swings, lengths = (np.concatenate(each) for each in zip(*parts, strict=True))
    return crossings, np.append(swings, state[3] - state[4]), lengths


@numba.njit(cache=True, nogil=True)
def _crossings(
    signal: Array, first: int, sign: float, middles: Array, halves: Array, state: Array
) -> tuple[Array, Array, Array]:
    """Upward crossings of the middle in samples, one for each way from lower to upper.

    Parameters
    ----------
    signal : the next samples, shape (sample,); times `sign` they are what goes upward
    first : number of its first sample
    sign : 1 or -1
    middles : threshold, shape (sample,) or (1,)
    halves : halves of the band about it, of the same shape
    state : shape (6,): the sample before, over its threshold, not a number at the start; 1 where
        the signal has been below the lower level since the last crossing; the last crossing of the
        middle; highest and lowest sample since the last pulse; last sample below the lower level.
        It is changed

    Returns
    -------
    crossings, swing of the signal since the one before each, samples from lower to upper level
    """
    crossings = np.empty(signal.size // 2 + 1)
    swings, lengths = np.empty(crossings.size), np.empty(crossings.size)
    count, is_one = 0, middles.size == 1
    before, armed, crossing = state[0], state[1] > 0.0, state[2]  # before: over the middle
    highest, lowest, below = state[3], state[4], state[5]
    for k in range(signal.size):
        after = sign * signal[k]
        middle, half = (middles[0], halves[0]) if is_one else (middles[k], halves[k])
        highest, lowest = max(highest, after), min(lowest, after)
        current = after - middle
        if armed and before < 0.0 <= current:
            crossing = first + k - 1 - before / (current - before)
        if armed and current >= half:
            crossings[count], swings[count] = crossing, highest - lowest
            lengths[count] = first + k - below
            count += 1
            armed, highest, lowest = False, after, after
        elif current <= -half:
            armed, below = True, float(first + k)
        before = current
    state[:] = (before, 1.0 if armed else 0.0, crossing, highest, lowest, below)
    return crossings[:count].copy(), swings[:count].copy(), lengths[:count].copy()
