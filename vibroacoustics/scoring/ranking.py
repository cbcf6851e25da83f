"""Ranking: from utilities to scores."""

from collections.abc import Callable
from typing import Final

import numpy as np

from ..base.arrays import Array


def weighted_sum(utility: Array, shares: Array) -> Array:
    """Sum of the utilities times their weights."""
    return utility @ shares


def topsis(utility: Array, shares: Array) -> Array:
    """Closeness to the ideal option (Hwang & Yoon 1981): d⁻ / (d⁺ + d⁻)."""
    to_ideal = np.linalg.norm((1.0 - utility) * shares, axis=1)
    to_worst = np.linalg.norm(utility * shares, axis=1)
    total = to_ideal + to_worst
    return np.where(total > 0.0, to_worst / np.where(total > 0.0, total, 1.0), 1.0)


METHODS: Final[dict[str, Callable[[Array, Array], Array]]] = {
    "weighted_sum": weighted_sum,
    "topsis": topsis,
}
