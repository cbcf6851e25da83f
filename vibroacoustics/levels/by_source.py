"""Sound by source: lines add as phasors, noise adds as energy."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import power_of_level
from ..base.vocabulary import WEIGHTINGS
from ..base.weighting import WEIGHTING
from ..mechanics.added import third_octave_number
from ..mechanics.received_sound import NoisePower, ReceivedSound
from ..study.baseline import HIGHEST_HZ, LOWEST_HZ
from .bands import Band, bands_between

LOWEST_BAND_HZ: Final = 20.0
GAIN_BANDS: Final = bands_between(3, LOWEST_HZ, HIGHEST_HZ)
"""Third octaves of discrepancies and of a baseline; the first and last hold what lies outside."""
_NO_BANDS: Final[Array] = np.zeros((1, 1, 1, 0))
A_FIRST: Final = tuple(sorted(WEIGHTINGS, key=lambda name: name != "A"))
"""Weightings of the totals of a study."""


class Measured(NamedTuple):
    """Third octaves of a baseline, and orders that count apart from them."""

    bands: Sequence[Band]
    orders: Sequence[float]


@dataclass(frozen=True)
class SourceSound:
    """Mean squares of the pressure at the receivers, by source; those of a band are unweighted.

    Attributes
    ----------
    band : mean square of each source alone, shape (source, receiver, band), Pa²
    alone : A-weighted, of each source alone, shape (source, receiver), Pa²
    part : contribution of each source to the total by weighting, shape (weighting, source,
        receiver), Pa²; where lines of two sources cancel a part can be negative. The sum is the
        total
    mutual : A-weighted mean squares of each pair of sources in `GAIN_BANDS`, half the real part
        of p q*, whose sum is the total, shape (source, source, receiver, gain band), Pa²
    band_hz : middle frequencies of the bands, shape (band,)
    order : shaft orders that were measured, complex peaks, shape (source, receiver, order), Pa
    order_hz : frequency of these orders, shape (order,)
    beside : mean square like `mutual`, without weighting and these orders, same shape, Pa²; empty
        without a baseline
    """

    band: Array
    alone: Array
    part: Array
    mutual: Array = field(default_factory=lambda: _NO_BANDS)
    band_hz: Array = field(default_factory=lambda: np.zeros(0))
    order: ComplexArray = field(default_factory=lambda: np.zeros((1, 1, 0), dtype=complex))
    order_hz: Array = field(default_factory=lambda: np.zeros(0))
    beside: Array = field(default_factory=lambda: _NO_BANDS)

    @property
    def unknown(self) -> "SourceSound":
        """The sound of a case without a solution: not a number."""
        parts = vars(self).items()
        return SourceSound(
            **{n: part if n.endswith("_hz") else np.full_like(part, np.nan) for n, part in parts}
        )

    @property
    def total(self) -> Array:
        """Mean square of all sources together by weighting, shape (weighting, receiver), Pa²."""
        return np.asarray(self.part.sum(axis=1))

    @property
    def order_total(self) -> ComplexArray:
        """Measured orders of all sources together, complex peaks, (receiver, order), Pa."""
        return np.asarray(self.order.sum(axis=0))

    @property
    def beside_total(self) -> Array:
        """Mean squares of all sources without these orders, (receiver, band), Pa²."""
        return np.asarray(self.beside.sum(axis=(0, 1)))

    @property
    def energy(self) -> Array:
        """A-weighted mean squares of each source alone, shape (source, receiver, gain band)."""
        return np.asarray(np.einsum("ssri->sri", self.mutual))

    def bands(self, gain: Array) -> Array:
        """Compute A-weighted mean squares of all sources together, shape (receiver, gain band).

        Parameters
        ----------
        gain : factors on the power of sources, shape (source, receiver, gain band)
        """
        root = np.sqrt(gain)
        return np.asarray(np.einsum("sri,tri,stri->ri", root, root, self.mutual))

    def scaled(self, gain: Array) -> "SourceSound":
        """Return the sound with sources that are louder by factors on their power.

        Phases stay: mutual terms of two sources change by the root of both factors.

        Parameters
        ----------
        gain : shape (source, receiver, gain band)
        """
        root = np.sqrt(gain)
        mutual = np.einsum("sri,tri,stri->sr", root, root, self.mutual)
        alone = np.einsum("sri,sri->sr", gain, self.energy)
        band = self.band * gain[..., gain_band_number(self.band_hz)]
        scaled = SourceSound(band, alone, mutual[None], band_hz=self.band_hz)
        if not self.beside.size:
            return scaled
        order = self.order * root[..., gain_band_number(self.order_hz)]
        return replace(scaled, order=order, beside=root[:, None] * root * self.beside)


def gain_band_number(frequency_hz: Array) -> IndexArray:
    """Column of `GAIN_BANDS` that holds a frequency, or the nearest one, shape (frequency,)."""
    lowest = third_octave_number(np.array(GAIN_BANDS[0].middle_hz))
    number = third_octave_number(frequency_hz) - lowest
    return np.asarray(np.clip(number, 0, len(GAIN_BANDS) - 1).astype(np.intp))


def filled_thirds(maximum_frequency_hz: float) -> tuple[Band, ...]:
    """Third-octave bands that frequencies up to a highest one fill."""
    bands = bands_between(3, LOWEST_BAND_HZ, maximum_frequency_hz)
    return tuple(band for band in bands if band.upper_hz <= maximum_frequency_hz)


def sound_by_source(
    received: ReceivedSound, bands: Sequence[Band], measured: Measured | None = None
) -> SourceSound:
    """Mean squares of one case, with totals by all weightings, A first."""
    hertz = received.lines.frequency_hz
    sound = source_sound(received.pressure, hertz, received.noise, bands, A_FIRST)
    if measured is None:
        return sound
    column = {name: number for number, name in enumerate(received.lines.names)}
    lines = [column.get(f"order {order:g}") for order in measured.orders]
    order = np.zeros((*received.pressure.shape[:2], len(lines)), dtype=complex)
    order_hz = np.zeros(len(lines))
    for number, line in enumerate(lines):
        if line is not None:
            order[..., number], order_hz[number] = received.pressure[..., line], hertz[line]
    others = hertz > 0.0
    others[[line for line in lines if line is not None]] = False
    beside = mutual_power(received.pressure[..., others]) @ membership(
        hertz[others], measured.bands
    )
    for random in received.noise:
        of_noise = random.power @ membership(random.frequency_hz, measured.bands)
        beside[random.source, random.source] += of_noise
    return replace(sound, order=order, order_hz=order_hz, beside=beside)


def mutual_power(pressure: ComplexArray) -> Array:
    """Half the real part of p q* of each pair of sources, shape (source, source, ...).

    Parameters
    ----------
    pressure : complex peaks, shape (source, ...)
    """
    return np.asarray(0.5 * (pressure[:, None] * pressure[None].conj()).real)


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
    frequency_hz : frequency of the lines, shape (line,); zero is no sound
    noise : noise of the sources that have some
    bands : bands of the result
    weightings : weightings of the totals, A first
    """
    alone = 0.5 * np.abs(pressure) ** 2
    pairs = mutual_power(pressure)
    audible = frequency_hz > 0.0
    weight = np.stack([weighting_power(name, frequency_hz) * audible for name in weightings])
    band = alone @ membership(frequency_hz, bands)
    weighted, part = alone @ weight[0], np.moveaxis(pairs.sum(axis=1) @ weight.T, -1, 0)
    mutual = pairs @ (_in_gain_band(frequency_hz) * weight[0][:, None])
    for random in noise:
        band[random.source] += random.power @ membership(random.frequency_hz, bands)
        loud = np.stack(
            [random.power @ weighting_power(name, random.frequency_hz) for name in weightings]
        )
        weighted[random.source] += loud[0]
        part[:, random.source] += loud
        in_band = a_weight_by_band(random.frequency_hz)
        mutual[random.source, random.source] += random.power @ in_band
    return SourceSound(
        band, weighted, part, mutual, np.array([third_octave.middle_hz for third_octave in bands])
    )


def a_weight_by_band(frequency_hz: Array) -> Array:
    """Return the factor of A-weighting on mean squares, in the gain band of each frequency.

    Shape (frequency, gain band); zero in the other bands.
    """
    return np.asarray(_in_gain_band(frequency_hz) * weighting_power("A", frequency_hz)[:, None])


def _in_gain_band(frequency_hz: Array) -> Array:
    """1 in the gain band of a frequency, shape (frequency, gain band)."""
    return np.eye(len(GAIN_BANDS))[gain_band_number(frequency_hz)]


def weighting_power(weighting: str, frequency_hz: Array) -> Array:
    """Factor of a weighting on mean squares."""
    return power_of_level(WEIGHTING[weighting](frequency_hz))


def membership(frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """1 where a frequency lies in a band, shape (frequency, band)."""
    edges = np.array([(band.lower_hz, band.upper_hz) for band in bands])
    within = (frequency_hz[:, None] >= edges[:, 0]) & (frequency_hz[:, None] < edges[:, 1])
    return within.astype(float)
