"""The best few designs of many, no two of them alike."""

from typing import Final

import numpy as np

from ...base.arrays import Array, IndexArray

_APART: Final = 0.05
"""Share of the range of at least one variable by which designs of one objective differ."""


def best_by_one(designs: Array, limits: Array, objective: Array, count: int) -> IndexArray:
    """Rows of the best designs by one objective, each apart from those before it.

    Parameters
    ----------
    designs : shape (design, variable)
    limits : of the variables, shape (variable, 2)
    objective : the less the better; infinite for designs that do not count
    count : at most
    """
    span = np.maximum(np.ptp(limits, axis=1), np.finfo(float).tiny)
    chosen: list[int] = []
    left = np.isfinite(objective)
    while left.any() and len(chosen) < count:
        row = int(np.argmin(np.where(left, objective, np.inf)))
        chosen.append(row)
        left &= (np.abs(designs - designs[row]) > _APART * span).any(axis=1)
    return np.array(chosen, dtype=np.intp)


def best_of_front(objectives: Array, count: int) -> IndexArray:
    """Rows of a front: its middle, then one after another that is farthest from those chosen.

    The middle is nearest to the least of each objective, each as a share of the front's range.

    Parameters
    ----------
    objectives : of the front, shape (design, objective)
    count : at most
    """
    low = objectives.min(axis=0)
    span = np.maximum(np.ptp(objectives, axis=0), np.finfo(float).tiny)
    share = (objectives - low) / span
    chosen = [int(np.argmin((share**2).sum(axis=1)))]
    distance = np.linalg.norm(share - share[chosen[0]], axis=1)
    while len(chosen) < count and distance.max() > _APART:
        chosen.append(int(np.argmax(distance)))
        distance = np.minimum(distance, np.linalg.norm(share - share[chosen[-1]], axis=1))
    return np.array(chosen, dtype=np.intp)
