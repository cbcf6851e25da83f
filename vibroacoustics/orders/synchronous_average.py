"""Synchronous average of a signal over the revolutions of the shaft."""

from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .angular import AngularSignal, joined


@dataclass(frozen=True)
class SynchronousAverage:
    """Mean over the revolutions at each crank angle, and how well it is known."""

    mean: Array
    """Shape (..., angle), from crank angle zero."""
    standard_error: Array
    """Standard error of the mean, from the residual after subtracting it, shape (..., angle)."""
    averages: int


def time_synchronous_average(signal: AngularSignal, revolutions: int = 1) -> SynchronousAverage:
    """Average over blocks of revolutions that begin at multiples of the block's angle.

    The standard error is s / √n with the n - 1 of the sample variance.

    Parameters
    ----------
    signal : over the crank angle
    revolutions : after which the signal repeats: 2 with half orders

    Raises
    ------
    ParameterError
        The signal holds fewer than two whole blocks.
    """
    average = RevolutionAverage(signal.samples_per_revolution, revolutions)
    average.add(signal)
    return average.result()


class RevolutionAverage:
    """Average over the revolutions of a signal that comes in pieces.

    Parameters
    ----------
    samples_per_revolution : samples per revolution of the signal
    revolutions : after which it repeats
    """

    def __init__(self, samples_per_revolution: int, revolutions: int = 1) -> None:
        if revolutions < 1:
            raise ParameterError(f"revolutions = {revolutions}: must be at least 1")
        self._revolutions = revolutions
        self._length = revolutions * samples_per_revolution
        self._averages = 0
        self._mean, self._squares = np.zeros(0), np.zeros(0)
        self._pending: AngularSignal | None = None

    def add(self, signal: AngularSignal) -> None:
        """Take the next samples of the signal."""
        signal = joined(self._pending, signal)
        begin = -signal.first_sample % self._length
        blocks = max(signal.time_s.size - begin, 0) // self._length
        if blocks:
            end = begin + blocks * self._length
            values = signal.values[..., begin:end]
            self._take(values.reshape(*values.shape[:-1], blocks, self._length), blocks)
            signal = signal.behind(end)
        self._pending = signal

    def _take(self, blocks: Array, number: int) -> None:
        """Put whole blocks (..., block, angle) into the mean and the sum of squares about it.

        Chan, Golub and LeVeque, The American Statistician 37, 1983, equation 2.1.
        """
        mean = np.mean(blocks, axis=-2)
        squares = np.sum((blocks - mean[..., None, :]) ** 2, axis=-2)
        if self._averages:
            step, total = mean - self._mean, self._averages + number
            squares += self._squares + step**2 * (self._averages * number / total)
            mean = self._mean + step * (number / total)
        self._mean, self._squares = mean, squares
        self._averages += number

    def result(self) -> SynchronousAverage:
        """The average of all that has been added.

        Raises
        ------
        ParameterError
            That holds fewer than two whole blocks.
        """
        if self._averages < 2:
            raise ParameterError(
                f"revolutions = {self._revolutions}: the signal holds {self._averages} whole "
                "blocks of them; an average needs two"
            )
        variance = self._squares / (self._averages - 1)
        return SynchronousAverage(
            mean=self._mean,
            standard_error=np.sqrt(variance) / np.sqrt(self._averages),
            averages=self._averages,
        )
