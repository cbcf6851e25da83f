"""Quantiles of values that count by weights."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from .arrays import Array

INTERVAL: Final = (0.1, 0.5, 0.9)
"""Probabilities of the ends of an 80 % interval and of its median."""
NORMAL_90: Final = 1.2815515655446004
"""Upper end of the 80 % interval of the standard normal distribution."""
_ROUNDING: Final = 1e-9
"""Relative error of a sum of weights."""


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
    sorted_values, sorted_weights = _sorted(values, weight)
    middle = np.cumsum(sorted_weights, axis=0) - 0.5 * sorted_weights
    middle -= middle[0].copy()
    middle /= np.where(middle[-1] > 0.0, middle[-1], 1.0)
    rows = [
        np.interp(shares, column, value)
        for column, value in zip(middle.T, sorted_values.T, strict=True)
    ]
    return np.transpose(rows).reshape(len(shares), *values.shape[1:])


def stepped_quantiles(values: Array, weight: Array, shares: Sequence[float]) -> Array:
    """Quantiles along the first axis of values in steps, shape (share, ...); each is a value.

    Least value up to which there is a share of the weight (inverted distribution function;
    Hyndman and Fan 1996, The American Statistician 50, 361, definition 1).

    Parameters
    ----------
    values, weight, shares : values, weights and shares, see `weighted_quantiles`
    """
    sorted_values, sorted_weights = _sorted(values, weight)
    cumulative = np.cumsum(sorted_weights, axis=0)
    rows = [
        np.take_along_axis(sorted_values, np.argmax(cumulative >= target, axis=0)[None], axis=0)
        for target in (share * (1.0 - _ROUNDING) * cumulative[-1] for share in shares)
    ]
    return np.concatenate(rows).reshape(len(shares), *values.shape[1:])


def _sorted(values: Array, weight: Array) -> tuple[Array, Array]:
    """Sorted values of weight above zero and their weights, both of shape (sample, column)."""
    is_counted = weight > 0.0
    columns = values[is_counted].reshape(np.count_nonzero(is_counted), -1)
    order = np.argsort(columns, axis=0)
    return np.take_along_axis(columns, order, axis=0), weight[is_counted][order]
