"""Weights of resampled ensembles."""

from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray

BOOTSTRAPS: Final = 200
_SEED: Final = 0


def bootstrap_weights(weight: Array, sample: IndexArray) -> Array:
    """Return weights of rows in resampled ensembles, each of sum one, shape (`BOOTSTRAPS`, row).

    Samples of any weight are chosen with replacement, each with all of its rows (Efron 1979,
    Ann. Stat. 7, 1).

    Parameters
    ----------
    weight : weights of the rows, shape (row,)
    sample : number of the independent sample that each row belongs to, shape (row,)
    """
    counting = weight > 0.0
    numbers, position = np.unique(sample[counting], return_inverse=True)
    chosen = np.random.default_rng(_SEED).integers(numbers.size, size=(BOOTSTRAPS, numbers.size))
    times = np.array([np.bincount(row, minlength=numbers.size) for row in chosen])
    weights = np.zeros((BOOTSTRAPS, weight.size))
    weights[:, counting] = weight[counting] * times[:, position]
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))
