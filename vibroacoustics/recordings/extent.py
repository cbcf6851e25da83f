"""Extent of the samples of a channel, by which a dead or an impossible one is recognised."""

from collections.abc import Iterable
from typing import Final, NamedTuple

import numpy as np

from .recorded import Recorded, Samples

PIECE: Final = 2**17
_FINEST_STEP: Final = 2.0**-24
"""Last bit of any recorder, share of the range: further bits of a wider format are padding."""


class Extent(NamedTuple):
    """Extent of the samples of a channel, in the unit of the file.

    Attributes
    ----------
    samples : number of samples
    lowest, highest : extreme values
    mean : mean value
    square : sum of the squared deviations from the mean
    step : last bit of the number format; 0 where the format has none
    """

    samples: int
    lowest: float
    highest: float
    mean: float
    square: float
    step: float

    @property
    def deviation(self) -> float:
        """Standard deviation."""
        return float(np.sqrt(self.square / self.samples))

    def joined(self, behind: "Extent") -> "Extent":
        """Return the extent of these samples and those behind them."""
        samples = self.samples + behind.samples
        with np.errstate(all="ignore"):
            apart = np.float64(behind.mean) - self.mean
            mean = self.mean + apart * (behind.samples / samples)
            between = apart**2 * (self.samples * behind.samples / samples)
        return Extent(
            samples,
            min(self.lowest, behind.lowest),
            max(self.highest, behind.highest),
            float(mean),
            float(self.square + behind.square + between),
            self.step,
        )


def extents(recording: Recorded) -> list[Extent]:
    """Extent of each channel; empty without a sample."""
    limits = recording.limits or [None] * len(recording.samples)
    pairs = zip(recording.samples, limits, strict=True)
    return [extent(samples, limit) for samples, limit in pairs if len(samples)]


def extent(samples: Samples, limits: tuple[float, float] | None = None) -> Extent:
    """Extent of the samples of a channel.

    Parameters
    ----------
    samples : at least one, shape (time,)
    limits : lowest and highest value that the number format can hold; None without
    """
    step = 0.0 if limits is None else max(-sum(limits), _FINEST_STEP * (limits[1] - limits[0]))
    starts = range(0, len(samples), PIECE)
    return joined(_of_piece(samples[start : start + PIECE], step) for start in starts)


def joined(parts: Iterable[Extent]) -> Extent:
    """Extent of parts that follow each other, of which there is one at least."""
    first, *others = parts
    for part in others:
        first = first.joined(part)
    return first


def _of_piece(samples: Samples, step: float) -> Extent:
    values = samples.astype(float)
    with np.errstate(all="ignore"):  # samples that are not finite are refused later
        mean = float(np.mean(values))
        square = float(np.sum((values - mean) ** 2))
    return Extent(values.size, float(values.min()), float(values.max()), mean, square, step)
