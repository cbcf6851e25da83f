"""Quantiles of values that count by weights."""

from collections.abc import Sequence

import numpy as np

from .arrays import Array


def weighted_quantiles(values: Array, weight: Array, shares: Sequence[float]) -> Array:
    """Quantiles along the first axis, shape (share, ...).

    Linear between sorted values, each at the middle of its weight, the least at 0 and the largest
    at 1: with equal weights numpy's own.

    Parameters
    ----------
    values : shape (sample, ...)
    weight : not below zero, shape (sample,); values of weight zero do not count
    shares : from 0 to 1
    """
    counting = weight > 0.0
    columns = values[counting].reshape(np.count_nonzero(counting), -1)
    order = np.argsort(columns, axis=0)
    sizes = weight[counting][order]
    middle = np.cumsum(sizes, axis=0) - 0.5 * sizes
    middle -= middle[0].copy()
    middle /= np.where(middle[-1] > 0.0, middle[-1], 1.0)
    rising = np.take_along_axis(columns, order, axis=0)
    rows = [np.interp(shares, at, of) for at, of in zip(middle.T, rising.T, strict=True)]
    return np.transpose(rows).reshape(len(shares), *values.shape[1:])
