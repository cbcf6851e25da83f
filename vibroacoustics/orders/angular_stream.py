"""A signal over the crank angle, block by block: the same samples as in one piece."""

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Final

import numpy as np

from ..base.arrays import Array
from .angular import AngularSignal, check_finite
from .angular_plan import AngularPlan, pieces
from .crank_motion import CrankMotion
from .low_pass import add_samples

_CHUNK_OUTPUTS: Final = 2**14
"""Work arrays of a few channels then stay in the cache."""
_BLOCK_SAMPLES: Final = 2**20
"""Samples of all channels that are worked on at a time: 8 MiB."""
_THREADS: Final = 2


def angular_resample(
    signal: Array, sample_rate_hz: float, motion: CrankMotion, maximum_order: float
) -> AngularSignal:
    """Signal over the crank angle, for orders up to a maximum.

    The kernel passes orders to the maximum and stops those from half the samples per revolution,
    or from half the sample rate at the highest speed where that is lower. It loses half of its
    length at either end: an output needs samples under the whole kernel.

    Parameters
    ----------
    signal : shape (..., time), uniformly sampled; sample 0 is at time zero
    sample_rate_hz : its sample rate
    motion : crank angle over (a part of) that time
    maximum_order : highest order to keep

    Raises
    ------
    ParameterError
        The sample rate is too low for the maximum order at the highest speed, the motion is
        shorter than the kernel, or a sample is not finite.
    """
    rows = signal.reshape(-1, signal.shape[-1])
    step = max(_BLOCK_SAMPLES // max(rows.shape[0], 1), 1)
    blocks = (rows[:, begin : begin + step] for begin in range(0, rows.shape[1], step))
    plan = AngularPlan(sample_rate_hz, rows.shape[1], motion, maximum_order)
    first, last = plan.grid
    resampled = AngularSignal(
        values=np.empty((rows.shape[0], last + 1 - first)),
        samples_per_revolution=plan.samples_per_revolution,
        first_sample=first,
        maximum_order=maximum_order,
        time_s=np.empty(last + 1 - first),
    )
    for part in angular_parts(plan, blocks):
        of_part = slice(part.first_sample - first, part.first_sample - first + part.time_s.size)
        resampled.values[:, of_part], resampled.time_s[of_part] = part.values, part.time_s
    return replace(resampled, values=resampled.values.reshape(*signal.shape[:-1], -1))


def angular_parts(plan: AngularPlan, blocks: Iterable[Array]) -> Iterator[AngularSignal]:
    """Parts of the signal over the angle that blocks end."""
    stream = None
    for block in blocks:
        stream = stream or AngularStream(plan, block.shape[0])
        yield stream.add(block)


class AngularStream:
    """Takes a recording block by block and gives the samples over the crank angle.

    Samples under the kernel of what is to come are kept from block to block.

    Parameters
    ----------
    plan : plan of the recording
    channels : number of its channels
    """

    def __init__(self, plan: AngularPlan, channels: int) -> None:
        self.plan = plan
        self._table = plan.low_pass.table()
        self._added = 0
        self._next = plan.grid[0]
        # Samples under the kernel of index `_next` and what follows.
        self._begin = plan.covered[0]
        self._rows: Array = np.empty((channels, 0))
        self._position: Array = np.empty(0)
        self._width: Array = np.empty(0)

    def add(self, block: Array) -> AngularSignal:
        """Take samples, shape (channel, time), and return those over the angle that they end."""
        check_finite(block)
        start, stop = self.plan.covered
        first, self._added = self._added, self._added + block.shape[1]
        self._join(block[:, max(start - first, 0) : max(stop - first, 0)])
        last = self._next - 1
        if self._position.size:
            complete = int(np.floor(self._position[-1])) - self.plan.low_pass.half_length
            last = min(max(complete, last), self.plan.grid[1])
        signal = self._until(last)
        self._next = last + 1
        self._forget(int(np.searchsorted(self._position, last - self.plan.low_pass.half_length)))
        return signal

    def _join(self, rows: Array) -> None:
        """Put samples with their positions behind those that are kept."""
        samples = np.arange(rows.shape[1], dtype=float) + self._begin + self._position.size
        position: Array = np.empty(samples.size)
        width: Array = np.empty(samples.size)
        for first, last in pieces(0, samples.size):
            position[first:last] = self.plan.position(samples[first:last])
            width[first:last] = self.plan.width(samples[first:last])
        if self._position.size:
            rows = np.concatenate([self._rows, rows], axis=1)
            position = np.concatenate([self._position, position])
            width = np.concatenate([self._width, width])
        self._rows, self._position, self._width = rows, position, width

    def _forget(self, samples: int) -> None:
        """Drop the first samples that are kept."""
        self._begin += samples
        self._rows = self._rows[:, samples:].copy()
        self._position, self._width = self._position[samples:].copy(), self._width[samples:].copy()

    def _until(self, last: int) -> AngularSignal:
        """The samples over the angle from the next one to this index of the grid."""
        first = self._next
        time_s: Array = np.empty(0)
        if last >= first:
            sample = _sample_at(np.arange(first, last + 1, dtype=float), self._position)
            time_s = (self._begin + sample) / self.plan.sample_rate_hz
        return AngularSignal(
            values=self._weighted_sums(first, last),
            samples_per_revolution=self.plan.samples_per_revolution,
            first_sample=first,
            maximum_order=self.plan.maximum_order,
            time_s=time_s,
        )

    def _weighted_sums(self, first: int, last: int) -> Array:
        """Low-passed signal at grid indices from first to last, (channel, index).

        Chunks of the grid are summed side by side; their bounds do not change a bit of the result,
        nor do the threads: each output adds up its samples in the order of time.
        """
        rows, position = self._rows, self._position
        half = self.plan.low_pass.half_length
        values = np.empty((rows.shape[0], last + 1 - first))

        def fill(start: int) -> None:
            stop = min(start + _CHUNK_OUTPUTS, last + 1)
            near = slice(
                int(np.searchsorted(position, start - half)),
                int(np.searchsorted(position, stop - 1 + half, side="right")),
            )
            sums = np.zeros((rows.shape[0], stop - start + 4 * half))
            block = np.ascontiguousarray(rows[:, near], dtype=float)
            offset = position[near] - (start - half)
            add_samples(block, offset, self._width[near], self._table, sums)
            wanted = 2 * half - 1  # sums begin at grid index start - half + 1 - half
            values[:, start - first : stop - first] = sums[:, wanted : wanted + stop - start]

        with ThreadPoolExecutor(_THREADS) as pool:
            list(pool.map(fill, range(first, last + 1, _CHUNK_OUTPUTS)))
        return values


def _sample_at(index: Array, position: Array) -> Array:
    """Samples, and parts of them, at which the angular grid has these indices."""
    lower = np.clip(np.searchsorted(position, index, side="right") - 1, 0, position.size - 2)
    share = (index - position[lower]) / (position[lower + 1] - position[lower])
    return np.asarray(lower + share)
