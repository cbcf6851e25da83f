"""Probability of each rank, over draws and weights of the criteria together."""

from collections.abc import Iterable, Iterator
from typing import Final

import numpy as np

from ..base.arrays import Array

_ROUNDING: Final = 1e-9
"""Sums that differ by less tie."""
_AT_ONCE: Final = 4096
"""Weightings that are compared in one array."""


def any_weights(criteria: int, number: int, seed: int) -> Iterator[Array]:
    """Weights of criteria of which nothing is known: uniform over all that sum up to one.

    Yields
    ------
    for one draw after another, without an end, other ones: shape (weighting, criterion)
    """
    generator = np.random.default_rng(seed)
    while True:
        yield generator.dirichlet(np.ones(criteria), size=number)


def rank_acceptability(utility: Array, draw_weight: Array, shares: Iterable[Array]) -> Array:
    """Probability of each position in the ranking, the first is best, (option, position).

    Rank acceptability index of stochastic multicriteria acceptability analysis, by Monte Carlo
    (Lahdelma & Salminen 2001, SMAA-2, Operations Research 49, 444-454, section 3), with the
    weighted sum as value of an option. Options that tie share their positions.

    Parameters
    ----------
    utility : of each option by each criterion, shape (draw, option, criterion)
    draw_weight : of the draws, shape (draw,), of any sum
    shares : weights of the criteria that go with each draw, each shape (weighting, criterion)
    """
    options = utility.shape[1]
    probability = np.zeros((options, options))
    for values, weight, weights in zip(utility, draw_weight, shares, strict=False):
        if weight > 0.0:
            probability += weight * _positions(values @ weights.T)
    return np.asarray(probability / draw_weight.sum())


def _positions(sums: Array) -> Array:
    """Share of the weightings in which an option takes a position, (option, position).

    Parameters
    ----------
    sums : of each option by each weighting, shape (option, weighting)
    """
    position = np.arange(len(sums))
    taken = np.zeros((len(sums), len(sums)))
    for start in range(0, sums.shape[1], _AT_ONCE):
        some = sums[:, start : start + _AT_ONCE]
        lead = some[None] - some[:, None]  # of the others over the option
        better = (lead > _ROUNDING).sum(axis=1)[..., None]
        tied = (np.abs(lead) <= _ROUNDING).sum(axis=1)[..., None]
        taken += (((position >= better) & (position < better + tied)) / tied).sum(axis=1)
    return taken / sums.shape[1]
