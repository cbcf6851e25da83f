"""Levels of a channel that comes in pieces: weightings, Fast and Slow, lines for bands.

Blocks under ramps that add up to one are transformed once each; weighted by A and by C they are put
together again, and their lines add up to the spectrum from which band levels come.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numba
import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level
from ..base.errors import ParameterError
from ..base.fourier import BlockTransform
from ..base.weighting import WEIGHTING
from .time_weighting import FAST_TIME_CONSTANT_S, SLOW_TIME_CONSTANT_S

RUN_IN_S: Final = 0.1
"""Length omitted at either end of A- and C-weighted signals: the slowest part of the weightings,
exp(-2π 20.6 Hz t), has then fallen to 2e-6."""
_BLOCK_S: Final = 2.5
"""Length of a transform: its lines lie 0.4 Hz apart, a fifteenth of the third octave at 25 Hz."""
_LEAST_BLOCK: Final = 16
"""Samples of a block at the least, for sample rates below 6 Hz."""
_FILTERED: Final = ("A", "C")
_SHORTEST_SHARE: Final = 4
"""Least length of a recording over the length omitted at either end."""
_TICK_S: Final = 0.01
"""Squares are summed over ticks of this length for levels over the time."""


@dataclass(frozen=True)
class MeterPlan:
    """Plan of the measurement of a recording, for all its channels.

    Attributes
    ----------
    samples : number of samples of the recording
    sample_rate_hz : sample rate of the recording
    """

    samples: int
    sample_rate_hz: float

    @cached_property
    def run_in(self) -> int:
        """Number of samples omitted at either end of A- and C-weighted signals."""
        return min(round(RUN_IN_S * self.sample_rate_hz), self.samples // _SHORTEST_SHARE)

    @property
    def run_in_s(self) -> float:
        """Length omitted at either end of A- and C-weighted signals, s."""
        return self.run_in / self.sample_rate_hz

    @cached_property
    def tick(self) -> int:
        """Samples whose squares are summed for levels over the time."""
        return max(round(_TICK_S * self.sample_rate_hz), 1)

    @property
    def ticks(self) -> int:
        """Number of ticks of the recording; the last may be shorter."""
        return -(-self.samples // self.tick)

    def measured(self, weighting: str) -> tuple[int, int]:
        """First sample that is measured with a weighting, and the one after the last."""
        omitted = 0 if weighting == "Z" else self.run_in
        return omitted, self.samples - omitted

    @cached_property
    def length(self) -> int:
        """Samples of a transform: of a block and of a run-in of silence on both sides."""
        most = min(self.samples, max(round(_BLOCK_S * self.sample_rate_hz), _LEAST_BLOCK))
        return int(fft.next_fast_len(most + 2 * self.run_in, real=True))

    @property
    def block(self) -> int:
        """Samples of a block, with its ramps."""
        return self.length - 2 * self.run_in

    @property
    def ramp(self) -> int:
        """Samples over which a block begins, and ends."""
        return self.run_in // 2

    @cached_property
    def rise(self) -> Array:
        """Half of a cosine over a ramp, which adds up to one with the fall of the block before."""
        return np.asarray(
            np.sin(0.5 * np.pi * (np.arange(self.ramp) + 0.5) / max(self.ramp, 1)) ** 2
        )

    @cached_property
    def block_window(self) -> Array:
        """Window of a full block."""
        return self.window(self.block)

    @cached_property
    def block_weight(self) -> float:
        """Sum of the squares of the window of a full block."""
        return _sum_of_squares(self.block_window)

    @cached_property
    def transform(self) -> BlockTransform:
        """Transform of a block; meters use it in turns."""
        return BlockTransform(self.length)

    def window(self, samples: int) -> Array:
        """Window of a block: one but for its ramps."""
        window = np.ones(samples)
        window[: self.ramp] *= self.rise
        window[samples - self.ramp :] *= self.rise[::-1]
        return window

    @cached_property
    def frequency_hz(self) -> Array:
        """Frequencies of the lines of a transform."""
        return np.asarray(fft.rfftfreq(self.length, 1.0 / self.sample_rate_hz))

    @cached_property
    def gain(self) -> dict[str, Array]:
        """Gain of the lines of a transform, by weighting."""
        return {
            name: np.asarray(amplitude_of_level(WEIGHTING[name](self.frequency_hz)))
            for name in _FILTERED
        }

    @cached_property
    def kept(self) -> Array:
        """Share of the Fast and of the Slow mean square that is left after a sample."""
        constants = np.array([FAST_TIME_CONSTANT_S, SLOW_TIME_CONSTANT_S])
        return np.asarray(np.exp(-1.0 / (self.sample_rate_hz * constants)))


class LevelMeter:
    """Mean squares of a channel by weighting, after all its samples have been added.

    Parameters
    ----------
    plan : plan of the recording
    offset : mean of all samples of the channel, which is no sound
    """

    def __init__(self, plan: MeterPlan, offset: float) -> None:
        self.plan, self.offset = plan, offset
        # Squares under the ramps of the blocks by line, and those of the ramps: `lines` over
        # `weight` add up to the mean square.
        self.lines = np.zeros(plan.frequency_hz.size)
        self.weight = 0.0
        self._state = {name: np.zeros(5) for name in "ZAC"}
        self.tick_squares = {name: np.zeros(plan.ticks) for name in "ZAC"}
        self._added = 0
        self._start = 0  # of the next block
        self._pending: Array = np.empty(0)  # samples from there on
        # Part of the blocks before: from a run-in before there on.
        self._tail: dict[str, Array] = {name: np.zeros(0) for name in _FILTERED}

    def add(self, piece: Array) -> None:
        """Take the next samples of the channel.

        Raises
        ------
        ParameterError
            A sample is not finite, or there are more than planned.
        """
        if not np.isfinite(piece.sum()) and not np.all(np.isfinite(piece)):
            raise ParameterError("signal: holds values that are not finite numbers")
        self._added += piece.size
        if self._added > self.plan.samples:
            raise ParameterError(f"signal: more than the {self.plan.samples} samples planned")
        self._pending = np.concatenate([self._pending, piece]) if self._pending.size else piece
        step = self.plan.block - self.plan.ramp
        while self._pending.size >= self.plan.block and self._rest > self.plan.block:
            self._add_block(self._pending[: self.plan.block], step)
            self._pending = self._pending[step:]
        if self._added == self.plan.samples and self._pending.size:
            self._add_block(self._pending, self._pending.size)
            self._pending = np.empty(0)

    @property
    def _rest(self) -> int:
        """Samples of the recording from the start of the next block on."""
        return self.plan.samples - self._start

    def _add_block(self, samples: Array, step: int) -> None:
        """Measure a block of which `step` samples come before the next one."""
        plan, is_full = self.plan, samples.size == self.plan.block
        window = plan.block_window if is_full else plan.window(samples.size)
        padded = plan.transform.samples
        sound = padded[plan.run_in : plan.run_in + samples.size]
        padded[: plan.run_in] = padded[plan.run_in + samples.size :] = 0.0
        np.subtract(samples, self.offset, out=sound)
        self._detect("Z", sound[:step], self._start)
        sound *= window
        spectrum = plan.transform.forward()
        self.lines += _one_sided(spectrum, plan.length)
        self.weight += plan.block_weight if is_full else _sum_of_squares(window)
        begin = 0 if self._start else 2 * plan.run_in  # of silence and of the recording
        for name in _FILTERED:
            weighted = plan.transform.inverse(spectrum, plan.gain[name])
            tail = self._tail[name]
            weighted[: tail.size] += tail
            self._tail[name] = weighted[step:].copy()
            self._detect(name, weighted[begin:step], self._start - plan.run_in + begin)
        self._start += step

    def _detect(self, name: str, signal: Array, first: int) -> None:
        """Measure samples of a weighted signal, of which the first has this number."""
        squares, tick = self.tick_squares[name], self.plan.tick
        _detect(signal, self.plan.kept, self._state[name], first, tick, squares)

    def mean_square(self, weighting: str) -> tuple[float, float, float]:
        """Mean over the recording, and greatest Fast and Slow mean square, unit squared."""
        samples = self.plan.samples - (0 if weighting == "Z" else 2 * self.plan.run_in)
        total, _, _, fast, slow = self._state[weighting]
        return float(total / samples), float(fast), float(slow)


def _sum_of_squares(window: Array) -> float:
    return float(np.sum(window**2))  # BLAS would start threads for it


def _one_sided(spectrum: ComplexArray, length: int) -> Array:
    """Square of each line over the length: together the sum of the squares of the samples."""
    energy = (spectrum.real**2 + spectrum.imag**2) / length
    energy[1 : (length + 1) // 2] *= 2.0
    return np.asarray(energy)


@numba.njit(cache=True, nogil=True, fastmath={"contract"})
def _detect(
    signal: Array, kept: Array, state: Array, first: int, tick: int, tick_squares: Array
) -> None:
    """Take samples into (sum of squares, Fast, Slow, greatest Fast, greatest Slow) and ticks."""
    total, fast, slow, most_fast, most_slow = state
    keep_fast, keep_slow = kept
    begin = 0
    while begin < signal.size:
        number = (first + begin) // tick
        end = min((number + 1) * tick - first, signal.size)
        part = 0.0
        for sample in range(begin, end):
            square = signal[sample] * signal[sample]
            part += square
            fast = keep_fast * fast + (1.0 - keep_fast) * square
            slow = keep_slow * slow + (1.0 - keep_slow) * square
            most_fast = max(most_fast, fast)
            most_slow = max(most_slow, slow)
        tick_squares[number] += part
        total += part
        begin = end
    state[:] = (total, fast, slow, most_fast, most_slow)
