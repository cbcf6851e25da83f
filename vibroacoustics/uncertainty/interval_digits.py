"""Sampling errors of quantiles, which set the digits that a reader sees."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.quantiles import weighted_quantiles

BOOTSTRAPS: Final = 200
_SEED: Final = 0


def bootstrap_weights(weight: Array, sample: IndexArray) -> Array:
    """Weights of rows in resampled ensembles, each of sum one, shape (`BOOTSTRAPS`, row).

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
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


def quantile_errors(values: Array, weight: Array, weights: Array, shares: Sequence[float]) -> Array:
    """Standard errors of weighted quantiles, shape (share,); zero where values are infinite.

    The deviation of the weight below a quantile over the ensembles, as a distance between the
    quantiles on either side (Woodruff 1952, J. Am. Stat. Assoc. 47, 635): the bootstrap of the
    quantile itself, without sorting each ensemble.

    Parameters
    ----------
    values, weight : shape (row,)
    weights : of `bootstrap_weights`
    shares : of the weight below each quantile
    """
    if not np.isfinite(values[weight > 0.0]).all():
        return np.zeros(len(shares))
    below = (values[:, None] <= weighted_quantiles(values, weight, shares)).astype(float)
    spread = np.std(weights @ below, axis=0, ddof=1)
    ends = np.clip([shares - spread, shares + spread], 0.0, 1.0)
    lower, upper = weighted_quantiles(values, weight, ends.ravel().tolist()).reshape(2, -1)
    return np.asarray(0.5 * (upper - lower))
