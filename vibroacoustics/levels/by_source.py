"""Sound by source: lines add as phasors, noise adds as energy."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import power_of_level
from .bands import Band, bands_between
from .weighting import WEIGHTING

LOWEST_BAND_HZ: Final = 20.0


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
class SourceSound:
    """Mean squares of the pressure at the receivers, by source; those of a band are unweighted.

    Attributes
    ----------
    band : of each source alone, shape (source, receiver, band), Pa²
    alone : A-weighted, of each source alone, shape (source, receiver), Pa²
    part : what each source adds to the total by weighting, shape (weighting, source, receiver),
        Pa²; where lines of two sources cancel a part can be negative. The sum is the total
    """

    band: Array
    alone: Array
    part: Array

    @property
    def total(self) -> Array:
        """Mean square of all sources together by weighting, shape (weighting, receiver), Pa²."""
        return np.asarray(self.part.sum(axis=1))


def filled_thirds(maximum_frequency_hz: float) -> tuple[Band, ...]:
    """Third-octave bands that frequencies up to a highest one fill."""
    bands = bands_between(3, LOWEST_BAND_HZ, maximum_frequency_hz)
    return tuple(band for band in bands if band.upper_hz <= maximum_frequency_hz)


def source_sound(
    pressure: ComplexArray,
    frequency_hz: Array,
    noise: Sequence[NoisePower],
    bands: Sequence[Band],
    weightings: Sequence[str] = ("A",),
) -> SourceSound:
    """Mean squares of the lines and of the noise of all sources.

    Parameters
    ----------
    pressure : complex peaks at the lines, shape (source, receiver, line), Pa
    frequency_hz : of the lines, shape (line,); zero is no sound
    noise : of the sources that have some
    bands : of the result
    weightings : of the totals, A first
    """
    alone = 0.5 * np.abs(pressure) ** 2
    shared = 0.5 * (pressure * pressure.sum(axis=0).conj()).real
    audible = frequency_hz > 0.0
    weight = np.stack([_power(name, frequency_hz) * audible for name in weightings])
    band = alone @ _membership(frequency_hz, bands)
    weighted, part = alone @ weight[0], np.moveaxis(shared @ weight.T, -1, 0)
    for own in noise:
        band[own.source] += own.power @ _membership(own.frequency_hz, bands)
        loud = np.stack([own.power @ _power(name, own.frequency_hz) for name in weightings])
        weighted[own.source] += loud[0]
        part[:, own.source] += loud
    return SourceSound(band, weighted, part)


def _power(weighting: str, frequency_hz: Array) -> Array:
    """Factor of a weighting on mean squares."""
    return power_of_level(WEIGHTING[weighting](frequency_hz))


def _membership(frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """1 where a frequency lies in a band, shape (frequency, band)."""
    edges = np.array([(band.lower_hz, band.upper_hz) for band in bands])
    within = (frequency_hz[:, None] >= edges[:, 0]) & (frequency_hz[:, None] < edges[:, 1])
    return within.astype(float)
