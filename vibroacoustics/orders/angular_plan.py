"""Plan of the conversion of samples over time to samples over crank angle, without aliasing.

With the angle φ(t) in revolutions, y(φ0) = ∫ x(t) h(φ(t) - φ0) φ'(t) dt is the signal over the
angle after the low-pass h: one kernel, of fixed length in angle, interpolates between the samples
and takes out what the angular grid cannot hold, at every speed. The integral is a sum over the
samples in time; it is exact to the kernel's ripple as long as the kernel's stop band begins below
half the sample rate.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import scipy.fft

from ..base.arrays import Array
from ..base.errors import ParameterError
from .crank_motion import CrankMotion
from .low_pass import LowPass, kaiser_low_pass

ATTENUATION_DB: Final = 100.0
"""Attenuation of everything that could alias; the gain up to the maximum order is as near to 1:
1e-5."""
HIGHEST_PASS_BAND_RATIO: Final = 0.9
"""Largest part of half the sample rate at the highest speed; above it is the kernel's
transition."""
_PIECE: Final = 2**18
"""Samples of which the motion is worked out at a time: a spline takes memory."""


@dataclass(frozen=True)
class AngularPlan:
    """Plan of the conversion of a recording of a length to samples over the crank angle.

    Attributes
    ----------
    sample_rate_hz : sample rate of the recording
    samples : number of samples of the recording, a channel
    motion : crank angle over (a part of) that time
    maximum_order : highest order to keep

    Raises
    ------
    ParameterError
        The sample rate is too low for the maximum order at the highest speed, or the motion is
        shorter than the kernel.
    """

    sample_rate_hz: float
    samples: int
    motion: CrankMotion
    maximum_order: float

    def __post_init__(self) -> None:
        limit = HIGHEST_PASS_BAND_RATIO * self.sample_rate_hz / (2.0 * self.highest_hz)
        if not 0.0 < self.maximum_order <= limit:
            raise ParameterError(
                f"maximum_order = {self.maximum_order:g}: must be above 0 and at most {limit:.4g} "
                f"at the highest speed, {60.0 * self.highest_hz:.0f} rpm, with "
                f"{self.sample_rate_hz:g} samples a second"
            )
        first, last = self.grid
        if last < first:
            spanned = (last - first) / self.samples_per_revolution + self.kernel_revolutions
            raise ParameterError(
                f"signal: {spanned:.3g} revolutions are too few; the anti-aliasing kernel spans "
                f"{self.kernel_revolutions:.3g}; a lower maximum_order shortens it"
            )

    @cached_property
    def covered(self) -> tuple[int, int]:
        """First sample at which the motion is known, and the one after the last."""
        return known_samples(self.motion, self.sample_rate_hz, self.samples)

    @cached_property
    def highest_hz(self) -> float:
        """Highest shaft frequency at a sample."""
        start, stop = self.covered
        return max(
            float(np.max(self.motion.frequency_hz(np.arange(first, last) / self.sample_rate_hz)))
            for first, last in pieces(start, stop)
        )

    @cached_property
    def samples_per_revolution(self) -> int:
        """Samples per revolution of the angular grid: at least four times the maximum order."""
        return 2 * int(scipy.fft.next_fast_len(int(np.ceil(2.0 * self.maximum_order))))

    @cached_property
    def low_pass(self) -> LowPass:
        """Passes the maximum order, stops what the grid or the sample rate cannot hold."""
        per_revolution = self.samples_per_revolution
        stop = min(per_revolution / 2.0, self.sample_rate_hz / (2.0 * self.highest_hz))
        return kaiser_low_pass(
            self.maximum_order / per_revolution, stop / per_revolution, ATTENUATION_DB
        )

    @property
    def kernel_revolutions(self) -> float:
        """Length of the low-pass."""
        return 2 * self.low_pass.half_length / self.samples_per_revolution

    @cached_property
    def grid(self) -> tuple[int, int]:
        """First and last index of the grid around which the whole kernel has samples."""
        start, stop = self.covered
        begin, end = self.position(np.array([start, stop - 1]))
        half = self.low_pass.half_length
        return int(np.ceil(begin)) + half, int(np.floor(end)) - half

    def position(self, sample: Array) -> Array:
        """Return the position of samples on the grid."""
        angle = self.motion.angle_rad(sample / self.sample_rate_hz)
        return np.asarray(angle * (self.samples_per_revolution / (2.0 * np.pi)))

    def width(self, sample: Array) -> Array:
        """Steps of the grid from a sample to the next."""
        frequency_hz = self.motion.frequency_hz(sample / self.sample_rate_hz)
        return np.asarray(frequency_hz * (self.samples_per_revolution / self.sample_rate_hz))


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


def pieces(start: int, stop: int) -> list[tuple[int, int]]:
    """First and last of pieces in which a motion is worked out."""
    return [(first, min(first + _PIECE, stop)) for first in range(start, stop, _PIECE)]
