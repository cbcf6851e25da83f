"""Sound of designs with the discrepancies of a sample: plain functions on arrays.

Axes are design, pair of a discrepancy and an unmodelled level, source, receiver, and line or gain
band, in this order. A nominal machine has one pair, and one source: all together.
"""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ...base.arrays import Array, ComplexArray, IndexArray
from ...uncertainty.discrepancy import with_added

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Gains:
    """Discrepancies of the pairs of a sample at one speed.

    Attributes
    ----------
    gain : factors on the power of sources, shape (pair, source, band)
    added : factors on what designs add, shape (pair,)
    before : energy of the machine without an option, shape (source, receiver, band), Pa²
    """

    gain: Array
    added: Array
    before: Array

    def of_designs(self, energy: Array) -> Array:
        """Return the factors on the power of designs, (design, pair, source, receiver, band).

        Parameters
        ----------
        energy : A-weighted energy of designs, shape (design, source, receiver, band), Pa²
        """
        return with_added(self.gain, self.added, energy[:, None], self.before)

    def of_bands(self, bands: Mask) -> "Gains":
        """Return the gains of some bands alone."""
        return Gains(self.gain[..., bands], self.added, self.before[..., bands])


@dataclass(frozen=True)
class WeightedLines:
    """Lines of one speed and their weights.

    Attributes
    ----------
    a_weight : A-weighted mean square per squared peak, shape (line,)
    level_weight : mean square per squared peak that counts, shape (line,)
    band : gain band of each line, shape (line,)
    noise : whether the mean square includes random loads
    gains : gains of the sample; none for the nominal machine
    """

    a_weight: Array
    level_weight: Array
    band: IndexArray
    noise: bool
    gains: Gains | None

    def mean_square(self, pressure: ComplexArray, noise: Array) -> Array:
        """Compute the mean square that is weighted, (design, pair, receiver), Pa².

        Parameters
        ----------
        pressure : complex peaks, shape (design or 1, source, receiver, line), Pa
        noise : A-weighted mean squares, shape (design or 1, source, receiver, band), Pa²
        """
        gain = self._gain(pressure, noise)
        square = line_squares(pressure, gain, self.band) @ self.level_weight
        if self.noise and noise.any():
            square = square + np.einsum("nksri,nsri->nkr", gain, noise)
        return np.asarray(square)

    def spectrum(self, pressure: ComplexArray, noise: Array, thirds: Array) -> tuple[Array, Array]:
        """Compute the unweighted mean squares of the lines and of the noise of all sources.

        Parameters
        ----------
        pressure, noise : see `mean_square`
        thirds : unweighted mean squares of noise, shape (design or 1, source, receiver, band), Pa²

        Returns
        -------
        shapes (design, pair, receiver, line) and (design or 1, pair, receiver, band), Pa²
        """
        gain = self._gain(pressure, noise)
        random = np.einsum("nksri,nsri->nkri", gain, thirds)
        return 0.5 * line_squares(pressure, gain, self.band), np.asarray(random)

    def _gain(self, pressure: ComplexArray, noise: Array) -> Array:
        """Factors on the power, shape (design or 1, pair, source, receiver, band)."""
        if self.gains is None:
            return np.ones((1, 1, 1, 1, noise.shape[-1]))
        return self.gains.of_designs(energy(pressure, self.a_weight, self.band, noise))

    def some(self, lines: Mask, bands: Mask) -> "WeightedLines":
        """Return some lines, whose bands are among some bands, alone."""
        number = np.cumsum(bands) - 1
        gains = None if self.gains is None else self.gains.of_bands(bands)
        return replace(
            self,
            a_weight=self.a_weight[lines],
            level_weight=self.level_weight[lines],
            band=number[self.band[lines]],
            gains=gains,
        )


def energy(pressure: ComplexArray, a_weight: Array, band: IndexArray, noise: Array) -> Array:
    """Compute the A-weighted mean squares of each source, (design, source, receiver, band), Pa².

    Parameters
    ----------
    pressure : complex peaks, shape (design, source, receiver, line), Pa
    a_weight : A-weighted mean square per squared peak, shape (line,)
    band : gain band of each line, shape (line,)
    noise : A-weighted mean squares, shape (design or 1, source, receiver, band), Pa²
    """
    member = a_weight[:, None] * np.eye(noise.shape[-1])[band]
    return np.asarray((pressure.real**2 + pressure.imag**2) @ member + noise)


def line_squares(pressure: ComplexArray, gain: Array, band: IndexArray) -> Array:
    """Compute the squared peaks of all sources together, (design, pair, receiver, line), Pa².

    Parameters
    ----------
    pressure : complex peaks, shape (design, source, receiver, line), Pa
    gain : factors on the power, shape (design or 1, pair, source, receiver, band)
    band : gain band of each line, shape (line,)
    """
    root = np.sqrt(gain)[..., band]
    total: ComplexArray = np.zeros(1, dtype=complex)
    for source in range(pressure.shape[1]):
        root_of_source = root[:, :, min(source, root.shape[2] - 1)]
        total = total + root_of_source * pressure[:, None, source]
    return np.asarray(total.real**2 + total.imag**2)


def varied_bands(
    change: ComplexArray, pressure: ComplexArray, lines: WeightedLines, noise: Array, share: float
) -> Mask:
    """Return the bands in which designs change the energy of a receiver by more than a share of it.

    Parameters
    ----------
    change : change of the pressure by designs, shape (design, source, receiver, line), Pa
    pressure : pressure without this change, shape (1, source, receiver, line), Pa
    lines : lines of the pressure
    noise : A-weighted mean squares of designs, shape (design, source, receiver, band), Pa²
    share : share of the energy in all bands
    """
    size = np.abs(change)
    more = size * (2.0 * np.abs(pressure) + size)
    changed = more @ (lines.a_weight[:, None] * np.eye(noise.shape[-1])[lines.band])
    changed = changed + np.ptp(noise, axis=0)
    total_energy = energy(pressure, lines.a_weight, lines.band, noise[:1])[0].sum(axis=(0, 2))
    least = share * np.maximum(total_energy, np.finfo(float).tiny)[:, None]
    return np.asarray((changed.max(axis=0).sum(axis=0) > least).any(axis=0))
