"""Samples of signals over the crank angle."""

from dataclasses import dataclass, replace

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError


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

    def behind(self, samples: int) -> "AngularSignal":
        """The signal without its first samples."""
        return replace(
            self,
            values=self.values[..., samples:].copy(),
            first_sample=self.first_sample + samples,
            time_s=self.time_s[samples:].copy(),
        )


def joined(first: AngularSignal | None, second: AngularSignal) -> AngularSignal:
    """A signal and what comes just behind it."""
    if first is None or not first.time_s.size:
        return second
    return replace(
        first,
        values=np.concatenate([first.values, second.values], axis=-1),
        time_s=np.concatenate([first.time_s, second.time_s]),
    )


def check_finite(signal: Array) -> None:
    """Refuse a signal with samples that are not finite: one spoils every spectrum it enters."""
    # Their sum shows it quickly; where it overflows the samples are looked at.
    if not np.isfinite(np.sum(signal)) and not np.all(np.isfinite(signal)):
        raise ParameterError("signal: has samples that are not finite")


def check_whole(samples: int, revolutions: int) -> int:
    """Samples of each revolution; refused where they are no whole number."""
    each, incomplete = divmod(samples, revolutions)
    if incomplete:
        raise ParameterError(
            f"signal: {samples} samples are not a whole number for each of "
            f"{revolutions} revolutions"
        )
    return each


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
    samples = check_whole(signal.shape[-1], revolutions)
    time_s = np.arange(signal.shape[-1]) / (samples * frequency_hz)
    return AngularSignal(np.asarray(signal, dtype=float), samples, 0, (samples - 1) // 2, time_s)
