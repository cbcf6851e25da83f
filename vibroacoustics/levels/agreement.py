"""Published data as evidence: how well a sample agrees with them, whatever the unmodelled noise is.

The machine's A-weighted bands are those of all modelled sources, M, and of unmodelled noise of
unknown level r. A sample and its discrepancy k count by

    w(k, r) = p(r) Π φ((predicted(M(k) + U(r)) - published) / s)

over all data, with p the prior of r on a grid of 1 dB, and φ the normal density over its largest
value.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from scipy.special import logsumexp

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, power_of_level
from ..base.vocabulary import PUBLISHED_LEVEL, PUBLISHED_SHARE
from ..machine.remainder import OverallNoise, UnmodelledNoise
from .by_source import GAIN_BANDS

LEVELS_DB: Final[Array] = np.linspace(-40.0, 10.0, 51, dtype=np.float64)
"""Levels of unmodelled noise relative to the published one."""


@dataclass(frozen=True)
class Prior:
    """Prior of the level of unmodelled noise.

    Attributes
    ----------
    name : in the results
    words : words after "unmodelled noise"
    density : at levels relative to the published one, dB, of any scale
    """

    name: str
    words: str
    density: Callable[[Array], Array]

    @property
    def log_density(self) -> Array:
        """Logarithm of the density at `LEVELS_DB`, whose sum is one."""
        density = self.density(LEVELS_DB)
        with np.errstate(divide="ignore"):
            return np.asarray(np.log(density / density.sum()))


PRIOR_NAMES: Final = ("flat", "near")
"""The first one is that of all intervals; the second one shows how much they depend on it."""


ALL_ALIKE: Final = Prior("even", "of none, as no level is published", np.ones_like)
"""Prior where no published datum weights samples."""


def priors_of(noise: UnmodelledNoise) -> tuple[Prior, ...]:
    """Return the priors of a machine's unmodelled noise, in the order of their names."""
    lowest, highest = noise.flat_lowest_db, noise.flat_highest_db
    near, deviation = noise.near_level_db, noise.near_deviation_db
    flat = f"anywhere from {_beside(lowest)} to {_beside(highest)} the published level"
    words = (flat, f"{_beside(near)} the published level, give or take {deviation:g} dB")
    densities = (partial(_flat, lowest, highest), partial(_near, near, deviation))
    return tuple(map(Prior, PRIOR_NAMES, words, densities))


def _beside(level_db: float) -> str:
    return f"{abs(level_db):g} dB {'below' if level_db < 0.0 else 'above'}"


def _flat(lowest_db: float, highest_db: float, level_db: Array) -> Array:
    return np.where((level_db >= lowest_db) & (level_db <= highest_db), 1.0, 0.0)


def _near(mean_db: float, deviation_db: float, level_db: Array) -> Array:
    return np.asarray(np.exp(-0.5 * ((level_db - mean_db) / deviation_db) ** 2))


@dataclass(frozen=True)
class Datum:
    """A published figure of the machine.

    Attributes
    ----------
    name : in the results
    value, deviation : published value and its standard deviation
    predicted : the figure from A-weighted `GAIN_BANDS` of the machine, (..., band) to (...), Pa²
    """

    name: str
    value: float
    deviation: float
    predicted: Callable[[Array], Array]

    def log_likelihood(self, bands: Array) -> Array:
        """Logarithm of the likelihood of bands (..., band), at best 0, shape (...)."""
        return np.asarray(-0.5 * ((self.predicted(bands) - self.value) / self.deviation) ** 2)


def data_of(noise: OverallNoise | None) -> tuple[Datum, ...]:
    """Return the published data of a machine, its level first."""
    if noise is None:
        return ()
    level = Datum(PUBLISHED_LEVEL, noise.likely_level_dba, noise.likely_deviation_db, _level)
    share = noise.spectral_share
    if share is None:
        return (level,)
    predicted = partial(_share, _part_below(share.below_hz))
    return (level, Datum(PUBLISHED_SHARE, share.share_ratio, share.deviation_ratio, predicted))


def _level(bands: Array) -> Array:
    return level_of_power(bands.sum(axis=-1) / REFERENCE_PRESSURE_PA**2)


def _share(below: Array, bands: Array) -> Array:
    total = bands.sum(axis=-1)
    return np.asarray(bands @ below / np.where(total > 0.0, total, 1.0))


def _part_below(frequency_hz: float) -> Array:
    """Part of each of `GAIN_BANDS` below a frequency, on the logarithm of frequency."""
    edges = np.log([(band.lower_hz, band.upper_hz) for band in GAIN_BANDS])
    below = (np.log(frequency_hz) - edges[:, 0]) / (edges[:, 1] - edges[:, 0])
    return np.asarray(np.clip(below, 0.0, 1.0))


def log_weights(modelled: Array, unmodelled: Array, data: Sequence[Datum], prior: Prior) -> Array:
    """Logarithm of prior times likelihood, shape (discrepancy, level of unmodelled noise).

    Parameters
    ----------
    modelled, unmodelled, data : see `log_likelihood`
    prior : prior of the level of unmodelled noise
    """
    return prior.log_density + log_likelihood(modelled, unmodelled, data)


def log_likelihood(modelled: Array, unmodelled: Array, data: Sequence[Datum]) -> Array:
    """Logarithm of the likelihood, shape (discrepancy, level of unmodelled noise).

    Parameters
    ----------
    modelled : A-weighted bands of all modelled sources, shape (discrepancy, band), Pa²
    unmodelled : A-weighted bands of unmodelled noise at the published level, shape (band,) or
        (discrepancy, band), Pa²
    data : that weigh the sample
    """
    bands = with_noise(modelled, unmodelled)
    likelihood = np.zeros(bands.shape[:2])
    for datum in data:
        likelihood += datum.log_likelihood(bands)
    likelihood[np.isnan(bands).any(axis=2)] = -np.inf
    return likelihood


def with_noise(modelled: Array, unmodelled: Array) -> Array:
    """Return the bands of the machine, (discrepancy, level of unmodelled noise, band), Pa².

    Parameters
    ----------
    modelled, unmodelled : see `log_likelihood`
    """
    noise = np.atleast_2d(unmodelled)[:, None]
    return np.asarray(modelled[:, None] + power_of_level(LEVELS_DB)[:, None] * noise)


def log_weight_of_points(over_db: Array, deviation_db: float, prior: Prior) -> Array:
    """Mean of the logarithms of the weights at several measured points, shape (sample,).

    Levels of one machine at several microphones and speeds deviate together, by an unknown amount:
    their likelihoods to the power of one over their number count as one measurement
    (composite likelihood: Varin, Reid and Firth 2011, Statistica Sinica 21, 5).

    Parameters
    ----------
    over_db : modelled relative to each measured level, shape (point, sample)
    deviation_db : standard deviation of these levels
    prior : prior of the level of unmodelled noise, relative to each measured one
    """
    power = power_of_level(over_db)[..., None] + power_of_level(LEVELS_DB)
    log_likelihood = -0.5 * (level_of_power(power) / deviation_db) ** 2
    weights = logsumexp(prior.log_density + log_likelihood, axis=-1).mean(axis=0)
    return np.where(np.isnan(weights), -np.inf, weights)


def effective_samples(weight: Array) -> float:
    """Number of equal samples of the same worth: (Σ w)² / Σ w² (Kish 1965)."""
    return float(weight.sum() ** 2 / (weight**2).sum()) if np.any(weight > 0.0) else 0.0
