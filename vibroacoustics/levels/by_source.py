"""Sound by source: lines add as phasors, noise adds as energy."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import power_of_level
from ..base.vocabulary import WEIGHTINGS
from ..mechanics.received_sound import NoisePower, ReceivedSound
from .bands import Band, bands_between
from .weighting import WEIGHTING

LOWEST_BAND_HZ: Final = 20.0
A_FIRST: Final = tuple(sorted(WEIGHTINGS, key=lambda name: name != "A"))
"""Weightings of the totals of a study."""


class Measured(NamedTuple):
    """What a baseline has: third octaves, and orders that count apart from them."""

    bands: Sequence[Band]
    orders: Sequence[float]


@dataclass(frozen=True)
class SourceSound:
    """Mean squares of the pressure at the receivers, by source; those of a band are unweighted.

    Attributes
    ----------
    band : of each source alone, shape (source, receiver, band), Pa²
    alone : A-weighted, of each source alone, shape (source, receiver), Pa²
    part : what each source adds to the total by weighting, shape (weighting, source, receiver),
        Pa²; where lines of two sources cancel a part can be negative. The sum is the total
    order : shaft orders that were measured, of all sources together, complex peaks, shape
        (receiver, order), Pa
    beside : of all sources without these orders in the bands of a baseline, shape (receiver,
        band), Pa²
    """

    band: Array
    alone: Array
    part: Array
    order: ComplexArray = field(default_factory=lambda: np.zeros((1, 0), dtype=complex))
    beside: Array = field(default_factory=lambda: np.zeros((1, 0)))

    @property
    def unknown(self) -> "SourceSound":
        """The same of a case without a solution: not a number."""
        return SourceSound(*(np.full_like(part, np.nan) for part in vars(self).values()))

    @property
    def total(self) -> Array:
        """Mean square of all sources together by weighting, shape (weighting, receiver), Pa²."""
        return np.asarray(self.part.sum(axis=1))


def filled_thirds(maximum_frequency_hz: float) -> tuple[Band, ...]:
    """Third-octave bands that frequencies up to a highest one fill."""
    bands = bands_between(3, LOWEST_BAND_HZ, maximum_frequency_hz)
    return tuple(band for band in bands if band.upper_hz <= maximum_frequency_hz)


def sound_by_source(
    received: ReceivedSound, bands: Sequence[Band], measured: Measured | None = None
) -> SourceSound:
    """Mean squares of one case, with totals by all weightings, A first.

    Parameters
    ----------
    received : of the case
    bands : of the result
    measured : bands and orders of a baseline; none where there is none
    """
    hertz = received.lines.frequency_hz
    sound = source_sound(received.pressure, hertz, received.noise, bands, A_FIRST)
    if measured is None:
        return sound
    column = {name: number for number, name in enumerate(received.lines.names)}
    lines = [column.get(f"order {order:g}") for order in measured.orders]
    order = np.zeros((received.pressure.shape[1], len(lines)), dtype=complex)
    for number, line in enumerate(lines):
        if line is not None:
            order[:, number] = received.pressure[..., line].sum(axis=0)
    others = hertz > 0.0
    others[[line for line in lines if line is not None]] = False
    square = 0.5 * np.abs(received.pressure[..., others].sum(axis=0)) ** 2
    beside = square @ membership(hertz[others], measured.bands)
    for random in received.noise:
        beside += random.power @ membership(random.frequency_hz, measured.bands)
    return replace(sound, order=order, beside=beside)


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
    weight = np.stack([weighting_power(name, frequency_hz) * audible for name in weightings])
    band = alone @ membership(frequency_hz, bands)
    weighted, part = alone @ weight[0], np.moveaxis(shared @ weight.T, -1, 0)
    for random in noise:
        band[random.source] += random.power @ membership(random.frequency_hz, bands)
        loud = np.stack(
            [random.power @ weighting_power(name, random.frequency_hz) for name in weightings]
        )
        weighted[random.source] += loud[0]
        part[:, random.source] += loud
    return SourceSound(band, weighted, part)


def weighting_power(weighting: str, frequency_hz: Array) -> Array:
    """Factor of a weighting on mean squares."""
    return power_of_level(WEIGHTING[weighting](frequency_hz))


def membership(frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """1 where a frequency lies in a band, shape (frequency, band)."""
    edges = np.array([(band.lower_hz, band.upper_hz) for band in bands])
    within = (frequency_hz[:, None] >= edges[:, 0]) & (frequency_hz[:, None] < edges[:, 1])
    return within.astype(float)
