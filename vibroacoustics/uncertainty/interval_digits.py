"""Sampling errors of quantiles, which set the digits that a reader sees."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray

BOOTSTRAPS: Final = 200
_SEED: Final = 0


def bootstrap_weights(weight: Array, sample: IndexArray) -> Array:
    """Weights of rows in resampled ensembles, shape (`BOOTSTRAPS`, row).

    Samples of any weight are chosen with replacement, each with all of its rows (Efron 1979,
    Ann. Stat. 7, 1).

    Parameters
    ----------
    weight : of the rows, shape (row,)
    sample : number of the independent sample that each row belongs to, shape (row,)
    """
    counting = weight > 0.0
    numbers, position = np.unique(sample[counting], return_inverse=True)
    chosen = np.random.default_rng(_SEED).integers(numbers.size, size=(BOOTSTRAPS, numbers.size))
    times = np.array([np.bincount(row, minlength=numbers.size) for row in chosen])
    weights = np.zeros((BOOTSTRAPS, weight.size))
    weights[:, counting] = weight[counting] * times[:, position]
    return weights


def quantile_errors(values: Array, weights: Array, shares: Sequence[float]) -> Array:
    """Standard errors of weighted quantiles, shape (share,); zero where the ensemble is infinite.

    Parameters
    ----------
    values : shape (row,)
    weights : of `bootstrap_weights`
    shares : of the weight below each quantile
    """
    counting = weights.any(axis=0)
    values, weights = values[counting], weights[:, counting]
    if not np.isfinite(values).all():
        return np.zeros(len(shares))
    order = np.argsort(values)
    rising, sizes = values[order], weights[:, order]
    quantiles = [_quantile(rising, sizes, share) for share in shares]
    return np.asarray(np.std(quantiles, axis=1, ddof=1))


def _quantile(rising: Array, sizes: Array, share: float) -> Array:
    """Quantile of rising values by each row of weights, as `weighted_quantiles` defines it."""
    held, last = sizes > 0.0, rising.size - 1
    middle = np.cumsum(sizes, axis=1) - 0.5 * sizes
    row, first = np.arange(len(sizes)), held.argmax(axis=1)
    end = last - held[:, ::-1].argmax(axis=1)
    sought = (1.0 - share) * middle[row, first] + share * middle[row, end]
    below = held & (middle <= sought[:, None])
    lower = last - below[:, ::-1].argmax(axis=1)
    upper = np.where(lower < end, (held & ~below).argmax(axis=1), lower)
    width = middle[row, upper] - middle[row, lower]
    part = (sought - middle[row, lower]) / np.where(width > 0.0, width, 1.0)
    return np.asarray(rising[lower] + part * (rising[upper] - rising[lower]))
