"""Sound of all sources at the receivers in one case, before any weighting."""

from dataclasses import dataclass, replace
from typing import NamedTuple

from ..base.arrays import Array, ComplexArray
from .added import InsertionLoss
from .loads import Lines


@dataclass(frozen=True)
class NoisePower:
    """Mean square of a source's noise at the receivers by frequency.

    Attributes
    ----------
    source : index of the source
    frequency_hz : shape (frequency,)
    power : shape (receiver, frequency), Pa²
    """

    source: int
    frequency_hz: Array
    power: Array


@dataclass(frozen=True)
class ReceivedSound:
    """Lines and noise at the receivers.

    Attributes
    ----------
    lines : lines of all sources
    pressure : complex peaks at the lines, shape (source, receiver, line), Pa
    noise : noise of the sources that have some
    """

    lines: Lines
    pressure: ComplexArray
    noise: tuple[NoisePower, ...]

    def behind(self, loss: InsertionLoss | None) -> "ReceivedSound":
        """Return the sound behind an insertion loss."""
        if loss is None:
            return self
        noise = [
            replace(part, power=part.power * loss.power_factor(part.frequency_hz))
            for part in self.noise
        ]
        pressure = self.pressure * loss.amplitude_factor(self.lines.frequency_hz)
        return ReceivedSound(self.lines, pressure, tuple(noise))


class PlateSound(NamedTuple):
    """Power of lines into a plate under the feet and from it, shape (..., line).

    Attributes
    ----------
    input_power_w : into the plate
    power_w : sound power to one side; zero where there is no line
    variance : variance of the sound power by the plate's modes, over its squared mean
    """

    input_power_w: Array
    power_w: Array
    variance: Array
