"""From samples over time to samples over crank angle, without aliasing.

With the angle φ(t) in revolutions, y(φ0) = ∫ x(t) h(φ(t) - φ0) φ'(t) dt is the signal over the
angle after the low-pass h: one kernel, of fixed length in angle, interpolates between the samples
and takes out what the angular grid cannot hold, at every speed. The integral is a sum over the
samples in time; it is exact to the kernel's ripple as long as the kernel's stop band begins below
half the sample rate.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy.fft

from ..base.arrays import Array
from ..base.errors import ParameterError
from .crank_motion import CrankMotion
from .low_pass import LowPass, add_samples, kaiser_low_pass

ATTENUATION_DB: Final = 100.0
"""Of everything that could alias; the gain up to the maximum order is as near to 1: 1e-5."""
HIGHEST_PASS_BAND_RATIO: Final = 0.9
"""Of half the sample rate at the highest speed: what is left is the kernel's transition."""
_CHUNK_OUTPUTS: Final = 2**14
"""Work arrays of a few channels then stay in the cache."""
_THREADS: Final = 2
_PIECE: Final = 2**18
"""Samples of which the motion is worked out at a time."""


@dataclass(frozen=True)
class AngularSignal:
    """Samples at crank angles 2π (first_sample + i) / samples_per_revolution.

    Nothing in it is aliased. Up to the maximum order the gain is 1, above it falls to zero at
    half the samples per revolution.
    """

    values: Array
    """Shape (..., sample), in the signal's unit."""
    samples_per_revolution: int
    first_sample: int
    """Grid index of the first sample; the grid's index 0 lies at crank angle zero."""
    maximum_order: float
    time_s: Array
    """Shape (sample,), from the start of the recording."""

    @property
    def revolution(self) -> Array:
        """Crank angle in revolutions, shape (sample,)."""
        index = self.first_sample + np.arange(self.time_s.size)
        return np.asarray(index / self.samples_per_revolution)


def check_finite(signal: Array) -> None:
    """Refuse a signal with samples that are not finite: one spoils every spectrum it enters."""
    if not np.all(np.isfinite(signal)):
        raise ParameterError("signal: has samples that are not finite")


def whole_revolutions(signal: Array, revolutions: int, frequency_hz: float) -> AngularSignal:
    """A simulated signal at constant speed that is sampled over the crank angle already.

    Parameters
    ----------
    signal : shape (..., sample), from crank angle zero over whole revolutions
    revolutions : number of revolutions that the samples span
    frequency_hz : shaft frequency

    Raises
    ------
    ParameterError
        The revolutions do not divide the samples, or a sample is not finite.
    """
    check_finite(signal)
    samples, rest = divmod(signal.shape[-1], revolutions)
    if rest:
        raise ParameterError(
            f"signal: {signal.shape[-1]} samples are not a whole number for each of "
            f"{revolutions} revolutions"
        )
    time_s = np.arange(signal.shape[-1]) / (samples * frequency_hz)
    return AngularSignal(np.asarray(signal, dtype=float), samples, 0, (samples - 1) // 2, time_s)


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
    check_finite(signal)
    start, stop = known_samples(motion, sample_rate_hz, signal.shape[-1])
    turned, frequency_hz = _motion_at_samples(motion, sample_rate_hz, start, stop)
    highest_hz = float(np.max(frequency_hz))
    _check_maximum_order(maximum_order, sample_rate_hz, highest_hz)
    samples_per_revolution = 2 * int(scipy.fft.next_fast_len(int(np.ceil(2.0 * maximum_order))))
    stop_order = min(samples_per_revolution / 2.0, sample_rate_hz / (2.0 * highest_hz))
    low_pass = kaiser_low_pass(
        maximum_order / samples_per_revolution, stop_order / samples_per_revolution, ATTENUATION_DB
    )
    position = np.multiply(turned, samples_per_revolution / (2.0 * np.pi), out=turned)
    width = np.multiply(frequency_hz, samples_per_revolution / sample_rate_hz, out=frequency_hz)
    first, last = _grid_within(position, low_pass.half_length, samples_per_revolution)
    rows = signal.reshape(-1, signal.shape[-1])[:, start:stop]
    values = _weighted_sums(rows, position, width, low_pass, first, last)
    return AngularSignal(
        values=values.reshape(*signal.shape[:-1], -1),
        samples_per_revolution=samples_per_revolution,
        first_sample=first,
        maximum_order=maximum_order,
        time_s=(start + _sample_at(np.arange(first, last + 1, dtype=float), position))
        / sample_rate_hz,
    )


def _motion_at_samples(
    motion: CrankMotion, sample_rate_hz: float, start: int, stop: int
) -> tuple[Array, Array]:
    """Crank angle and frequency at samples, worked out in pieces: a spline takes memory."""
    angle, frequency = np.empty(stop - start), np.empty(stop - start)
    for first in range(start, stop, _PIECE):
        last = min(first + _PIECE, stop)
        time_s = np.arange(first, last) / sample_rate_hz
        angle[first - start : last - start] = motion.angle_rad(time_s)
        frequency[first - start : last - start] = motion.frequency_hz(time_s)
    return angle, frequency


def _sample_at(index: Array, position: Array) -> Array:
    """Samples, and parts of them, at which the angular grid has these indices."""
    lower = np.clip(np.searchsorted(position, index, side="right") - 1, 0, position.size - 2)
    share = (index - position[lower]) / (position[lower + 1] - position[lower])
    return np.asarray(lower + share)


def known_samples(motion: CrankMotion, sample_rate_hz: float, samples: int) -> tuple[int, int]:
    """First sample at which the motion is known, and the one after the last."""
    if not sample_rate_hz > 0.0:
        raise ParameterError(f"sample_rate_hz = {sample_rate_hz:g}: must be above 0 Hz")
    first = max(int(np.ceil(motion.start_s * sample_rate_hz)), 0)
    last = min(int(np.floor(motion.end_s * sample_rate_hz)), samples - 1)
    if last <= first:
        raise ParameterError(
            f"motion: known from {motion.start_s:.4g} s to {motion.end_s:.4g} s, the signal lasts "
            f"from 0 s to {(samples - 1) / sample_rate_hz:.4g} s; they must overlap"
        )
    return first, last + 1


def _check_maximum_order(order: float, sample_rate_hz: float, highest_hz: float) -> None:
    limit = HIGHEST_PASS_BAND_RATIO * sample_rate_hz / (2.0 * highest_hz)
    if not 0.0 < order <= limit:
        raise ParameterError(
            f"maximum_order = {order:g}: must be above 0 and at most {limit:.4g} at the highest "
            f"speed, {60.0 * highest_hz:.0f} rpm, with {sample_rate_hz:g} samples a second"
        )


def _grid_within(position: Array, half_length: int, samples_per_revolution: int) -> tuple[int, int]:
    """First and last index of the angular grid around which the whole kernel has samples."""
    first = int(np.ceil(position[0])) + half_length
    last = int(np.floor(position[-1])) - half_length
    if last < first:
        spanned = (position[-1] - position[0]) / samples_per_revolution
        raise ParameterError(
            f"signal: {spanned:.3g} revolutions are too few; the anti-aliasing kernel spans "
            f"{2 * half_length / samples_per_revolution:.3g}; a lower maximum_order shortens it"
        )
    return first, last


def _weighted_sums(
    signal: Array, position: Array, width: Array, low_pass: LowPass, first: int, last: int
) -> Array:
    """Low-passed signal at grid indices from first to last, (channel, index).

    Chunks of the grid are summed side by side; their bounds do not depend on the threads, so
    neither does a bit of the result.
    """
    half = low_pass.half_length
    table = low_pass.table()
    values = np.empty((signal.shape[0], last + 1 - first))

    def fill(start: int) -> None:
        stop = min(start + _CHUNK_OUTPUTS, last + 1)
        near = slice(
            int(np.searchsorted(position, start - half)),
            int(np.searchsorted(position, stop - 1 + half, side="right")),
        )
        sums = np.zeros((signal.shape[0], stop - start + 4 * half))
        block = np.ascontiguousarray(signal[:, near], dtype=float)
        add_samples(block, position[near] - (start - half), width[near], table, sums)
        wanted = 2 * half - 1  # sums begin at grid index start - half + 1 - half
        values[:, start - first : stop - first] = sums[:, wanted : wanted + stop - start]

    with ThreadPoolExecutor(_THREADS) as pool:
        list(pool.map(fill, range(first, last + 1, _CHUNK_OUTPUTS)))
    return values
