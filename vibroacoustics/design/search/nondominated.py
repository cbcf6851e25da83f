"""Which designs no other is better than in every objective."""

from typing import Final

import numpy as np
import numpy.typing as npt

from ...base.arrays import Array

Mask = npt.NDArray[np.bool_]
_BLOCK: Final = 256


def nondominated(objectives: Array) -> Mask:
    """Rows that no other row is at most equal to everywhere and below somewhere.

    Equal rows stay together. In the order of the first objective, then the second and so on, a row
    can only be dominated by one before it.

    Parameters
    ----------
    objectives : each the better the less, shape (design, objective); rows with a value that is not
        a number are dominated
    """
    sound = np.flatnonzero(np.isfinite(objectives).all(axis=1))
    order = sound[np.lexsort(objectives[sound].T[::-1])]
    front = np.empty((0, objectives.shape[1]))
    mask = np.zeros(len(objectives), dtype=bool)
    for start in range(0, len(order), _BLOCK):
        rows = order[start : start + _BLOCK]
        rows = rows[~_dominated(objectives[rows], front)]
        rows = rows[~_dominated(objectives[rows], objectives[rows])]
        mask[rows] = True
        front = np.concatenate([front, objectives[rows]])
    return mask


def _dominated(rows: Array, by: Array) -> Mask:
    """Whether each row is dominated by one of the others, shape (row,)."""
    difference = rows[:, None] - by[None]
    at_most, below = np.all(difference >= 0.0, axis=2), np.any(difference > 0.0, axis=2)
    return np.asarray(np.any(at_most & below, axis=1))
