"""Probability of each rank, over samples and weights of the criteria together."""

from collections.abc import Iterable, Iterator
from typing import Final

import numba
import numpy as np

from ..base.arrays import Array

_ROUNDING: Final = 1e-9
"""Sums that differ by less tie."""


def any_weights(criteria: int, number: int, seed: int) -> Iterator[Array]:
    """Weights of criteria of which nothing is known: uniform over all that sum up to one.

    Yields
    ------
    for one sample after another, without an end, other ones: shape (weighting, criterion)
    """
    generator = np.random.default_rng(seed)
    while True:  # Dirichlet's distribution of ones
        parts = generator.standard_exponential((number, criteria))
        yield parts / parts.sum(axis=1, keepdims=True)


def rank_acceptability(utility: Array, sample_weight: Array, shares: Iterable[Array]) -> Array:
    """Probability of each position in the ranking, the first is best, (option, position).

    Rank acceptability index of stochastic multicriteria acceptability analysis, by Monte Carlo
    (Lahdelma & Salminen 2001, SMAA-2, Operations Research 49, 444-454, section 3), with the
    weighted sum as value of an option. Options that tie share their positions.

    Parameters
    ----------
    utility : utility of each option by each criterion, shape (sample, option, criterion)
    sample_weight : weight of the samples, shape (sample,), of any sum
    shares : weights of the criteria that go with each sample, each shape (weighting, criterion)
    """
    options = utility.shape[1]
    probability = np.zeros((options, options))
    for values, weight, weights in zip(utility, sample_weight, shares, strict=False):
        if weight > 0.0:
            probability += weight * _positions(weights @ values.T)
    return np.asarray(probability / sample_weight.sum())


# With its types, so that it is compiled where it is imported: a check does not rank.
@numba.njit("float64[:, ::1](float64[:, ::1])", cache=True, nogil=True, error_model="numpy")
def _positions(sums: Array) -> Array:
    """Share of the weightings in which an option takes a position, (option, position).

    Parameters
    ----------
    sums : sums of each option by each weighting, shape (weighting, option)
    """
    weightings, options = sums.shape
    taken = np.zeros((options, options))
    for row in range(weightings):
        for option in range(options):
            better, tied = 0, 0
            for other in range(options):
                lead = sums[row, other] - sums[row, option]
                better += lead > _ROUNDING
                tied += abs(lead) <= _ROUNDING
            for position in range(better, better + tied):
                taken[option, position] += 1.0 / tied
    return np.asarray(taken / weightings)
