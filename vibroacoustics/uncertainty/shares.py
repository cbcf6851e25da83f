"""Shares of single unknowns in a quantity or a choice, from the samples at hand.

Samples are sorted into bins of about equal weight of one unknown after another; means in a bin
are those of all samples in which the unknown has such a value. Chance fills bins unequally too:
the permutation floor is what the largest of as many unknowns reaches that decide nothing.
"""

from typing import Final, NamedTuple

import numpy as np
from scipy import sparse

from ..base.arrays import Array
from ..base.quantiles import weighted_quantiles
from .bootstrap import bootstrap_weights

BINS: Final = 10
PERMUTATIONS: Final = 200
FLOOR: Final = 0.95
"""Share of the permutations in which no unknown that decides nothing lies above the floor."""
ENDS: Final = (0.1, 0.9)
"""Ends of the bootstrap interval of a share."""
ASKED: Final = 5
"""Number of bootstraps that are asked which unknown to measure."""
_SEED: Final = 0
_NOTHING: Final = 1e-12
"""Variance, of the square of the largest value, of a quantity that does not vary."""


class Shares(NamedTuple):
    """Shares of first order, Var(E[quantity | unknown]) / Var(quantity).

    Attributes
    ----------
    share : share of each unknown, shape (unknown,)
    low, high : ends of their bootstrap intervals, shape (unknown,)
    floor : permutation floor
    """

    share: Array
    low: Array
    high: Array
    floor: float


class Information(NamedTuple):
    """Expected gain in utility from knowing an unknown before choosing an option.

    Attributes
    ----------
    gain : gain of each unknown, shape (unknown,)
    votes : number of the bootstraps in which it has the largest gain, shape (unknown,)
    floor : permutation floor
    """

    gain: Array
    votes: Array
    floor: float


def shares_of(unknown: Array, value: Array, weight: Array) -> Shares:
    """Shares of unknowns in the variance of a quantity over weighted samples.

    Estimated from given data (Plischke, Borgonovo and Smith 2013, European Journal of Operational
    Research 226, 536), less what chance adds to the variance between bins (Kelley 1935, PNAS 21,
    554). Where weights make unknowns depend on one another, a share includes what one
    implies about the others.

    Parameters
    ----------
    unknown : shape (sample, unknown)
    value : the quantity, shape (sample,); not a number where a sample has no solution
    weight : weights of the samples, shape (sample,)

    Returns
    -------
    Shares; not a number where no sample has a weight
    """
    weight = np.where(np.isfinite(value), weight, 0.0)
    if not weight.any():
        none = np.full(unknown.shape[1], np.nan)
        return Shares(none, none, none, float("nan"))
    value = np.nan_to_num(value)
    member, order = _members(unknown, weight), _permutations(len(value))
    resampled = bootstrap_weights(weight, np.arange(len(value))).T
    low, high = np.quantile(_first_order(member, resampled, value[:, None]), ENDS, axis=1)
    permuted = _first_order(member, weight[order], value[order])
    (share,) = _first_order(member, weight[:, None], value[:, None]).T
    return Shares(share, low, high, float(np.quantile(permuted.max(axis=0), FLOOR)))


def information_of(unknown: Array, utility: Array, weight: Array) -> Information:
    """Expected value of knowing one unknown perfectly (EVPPI) for a choice among options.

    E[max E[utility | unknown]] − max E[utility], from given data (Strong and Oakley 2013, Medical
    Decision Making 33, 755).

    Parameters
    ----------
    unknown : shape (sample, unknown)
    utility : utilities of the options, shape (sample, option)
    weight : weights of the samples, shape (sample,); some are above zero
    """
    member, order = _members(unknown, weight), _permutations(len(weight))
    resampled = bootstrap_weights(weight, np.arange(len(weight)))[:ASKED].T
    votes = _gain(member, resampled, utility[..., None]).argmax(axis=0)
    permuted = _gain(member, weight[order], np.moveaxis(utility[order], 1, 2))
    (gain,) = _gain(member, weight[:, None], utility[..., None]).T
    counts = np.bincount(votes, minlength=unknown.shape[1]).astype(float)
    return Information(gain, counts, float(np.quantile(permuted.max(axis=0), FLOOR)))


def _members(unknown: Array, weight: Array) -> sparse.csr_array:
    """Ones where a sample is in a bin, shape (unknown and bin, sample); equal values share one."""
    limits = weighted_quantiles(unknown, weight, (np.arange(1, BINS) / BINS).tolist())
    number = (unknown > limits[:, None]).sum(axis=0) + BINS * np.arange(unknown.shape[1])
    sample = np.broadcast_to(np.arange(len(unknown))[:, None], unknown.shape)
    shape = (BINS * unknown.shape[1], len(unknown))
    return sparse.csr_array((np.ones(unknown.size), (number.ravel(), sample.ravel())), shape=shape)


def _permutations(count: int) -> Array:
    """Orders of the samples, shape (sample, permutation)."""
    rows = np.tile(np.arange(count), (PERMUTATIONS, 1))
    return np.asarray(np.random.default_rng(_SEED).permuted(rows, axis=1).T)


def _first_order(member: sparse.csr_array, weight: Array, value: Array) -> Array:
    """Shares of first order, shape (unknown, ensemble).

    Parameters
    ----------
    member : memberships, see `_members`
    weight, value : shape (sample, ensemble)
    """
    weight = weight / weight.sum(axis=0)
    value = value - (weight * value).sum(axis=0)
    variance = (weight * value**2).sum(axis=0)
    of_bin = member @ weight
    of_bin[of_bin == 0.0] = 1.0
    between = _summed((member @ (weight * value)) ** 2 / of_bin)
    chance = _summed((member @ weight**2) / of_bin)  # of the variance within bins
    within = (variance - between) / np.maximum(1.0 - chance, _NOTHING)
    unbiased = between - (chance - (weight**2).sum(axis=0)) * within
    size = np.maximum(unbiased + within, _NOTHING * (1.0 + (value**2).max(axis=0)))
    return np.asarray(np.clip(unbiased / size, 0.0, 1.0))


def _gain(member: sparse.csr_array, weight: Array, utility: Array) -> Array:
    """Expected gain of knowing each unknown, shape (unknown, ensemble).

    Parameters
    ----------
    member : memberships, see `_members`
    weight : shape (sample, ensemble)
    utility : shape (sample, option, ensemble)
    """
    weighted = (weight / weight.sum(axis=0))[:, None] * utility
    of_bin = member @ weighted.reshape(len(weighted), -1)
    best = of_bin.reshape(-1, *weighted.shape[1:]).max(axis=1)
    return np.asarray(_summed(best) - weighted.sum(axis=0).max(axis=0))


def _summed(of_bin: Array) -> Array:
    """Sum over the bins of each unknown, shape (unknown, ensemble)."""
    return np.asarray(of_bin.reshape(-1, BINS, of_bin.shape[-1]).sum(axis=1))
