"""How well a draw agrees with the published level, and what remainder it then leaves.

The level of the whole machine is that of what is modelled and of a remainder of unknown level r. A
draw counts by its likelihood, in which the remainder is averaged over its prior p(r):

    w = ∫ p(r) φ((L_published - L(m + r)) / s) dr

with s the standard deviation of the published level and φ the normal density over its largest
value, so that w is 1 at best; its remainder has the density p(r) φ(...) / w. No draw is cut off.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..machine.remainder import Remainder

_BELOW_DB: Final[Array] = np.linspace(-40.0, 10.0, 1001, dtype=np.float64)
"""Levels of the remainder over the published one, at which the integral is summed."""
_THREE_DEVIATIONS: Final = float(np.exp(-4.5))
"""φ there."""


@dataclass(frozen=True)
class Prior:
    """What is held of the remainder before anything is computed.

    Attributes
    ----------
    name : as the results have it
    words : of it, after "a remainder"
    density : of its level over the published one, dB, of any size
    """

    name: str
    words: str
    density: Callable[[Array], Array]


PRIOR_NAMES: Final = ("flat", "near")
"""The first one is that of the bands; the others tell how much they hang on it."""


ALL_ALIKE: Final = Prior("even", "of none, as no level is published", np.ones_like)
"""Where nothing is published that weighs draws."""


def priors_of(remainder: Remainder) -> tuple[Prior, ...]:
    """The priors of a machine's remainder, in the order of their names."""
    lowest, highest = remainder.flat_lowest_db, remainder.flat_highest_db
    near, deviation = remainder.near_level_db, remainder.near_deviation_db
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


def agreement(modelled_db: Array, deviation_db: float, prior: Prior) -> Array:
    """Weights of draws, shape (draw,), from 0 to 1; 0 where one has no solution.

    Parameters
    ----------
    modelled_db : what is modelled over the published level, shape (draw,); not a number where a
        draw has no solution
    deviation_db : standard deviation of the published level
    prior : of the remainder
    """
    density = _density(modelled_db, deviation_db, prior)
    return np.asarray(np.nan_to_num(density.sum(axis=1) / prior.density(_BELOW_DB).sum()))


def agreement_of_points(over_db: Array, deviation_db: float, prior: Prior) -> Array:
    """Geometric mean of the weights of draws at several points, shape (draw,), from 0 to 1.

    Levels of one machine at several microphones and speeds are off together, by how much of them
    is not known: their likelihoods to the power of one over their number count as one measurement
    (composite likelihood: Varin, Reid and Firth 2011, Statistica Sinica 21, 5).

    Parameters
    ----------
    over_db : what is modelled over each measured level, shape (point, draw)
    deviation_db, prior : as of `agreement`
    """
    weights = np.array([agreement(one, deviation_db, prior) for one in over_db])
    return np.asarray(np.prod(weights ** (1.0 / len(over_db)), axis=0))


def remainder_level(modelled_db: Array, deviation_db: float, prior: Prior, share: Array) -> Array:
    """Level of each draw's remainder over the published one, shape (draw,), dB.

    Parameters
    ----------
    modelled_db, deviation_db, prior : as of `agreement`
    share : of the density of each draw's remainder that lies below it, shape (draw,), from 0 to 1
    """
    rising = np.cumsum(np.nan_to_num(_density(modelled_db, deviation_db, prior)), axis=1)
    below = rising <= share[:, None] * rising[:, -1:]
    return np.asarray(_BELOW_DB[np.minimum(below.sum(axis=1), _BELOW_DB.size - 1)])


def effective_draws(weight: Array) -> float:
    """Number of equal draws that would be as good: (Σ w)² / Σ w² (Kish 1965).

    Draws that all contradict the published level alike are no good: only those within three
    deviations of it count.
    """
    agree = weight[weight >= _THREE_DEVIATIONS]
    return float(agree.sum() ** 2 / (agree**2).sum()) if agree.size else 0.0


def _density(modelled_db: Array, deviation_db: float, prior: Prior) -> Array:
    """Prior times likelihood, shape (draw, level)."""
    power = power_of_level(modelled_db)[:, None] + power_of_level(_BELOW_DB)
    off = level_of_power(power) / deviation_db
    return np.asarray(prior.density(_BELOW_DB) * np.exp(-0.5 * off**2))
