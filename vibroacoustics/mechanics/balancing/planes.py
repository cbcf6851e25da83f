"""Planes that act alike, and answers that need no large masses in opposition."""

from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from .moments import least_squares_moments

DEPENDENT: Final = 15.0
"""Condition number of influence coefficients, each plane of size one, above which planes are named:
scatter of the readings in the direction of the planes' difference grows by it."""
_PART: Final = 0.3


class Dependence(NamedTuple):
    """Dependence of planes.

    Attributes
    ----------
    condition : largest over smallest singular value of the influence of planes of size one
    planes : numbers of the planes that act alike, empty where the condition is sound
    """

    condition: float
    planes: tuple[int, ...]


def dependence(influence: ComplexArray) -> Dependence:
    """Find planes that act alike at all readings.

    Parameters
    ----------
    influence : weighted, shape (row, plane)
    """
    _, spread, directions = np.linalg.svd(influence / _size(influence), full_matrices=False)
    planes = influence.shape[1]
    smallest = spread[-1] if len(influence) >= planes else 0.0
    condition = float(spread[0] / smallest) if smallest > 0.0 else float("inf")
    if condition <= DEPENDENT:
        return Dependence(condition, ())
    weak = spread < spread[0] / DEPENDENT
    parts = np.linalg.norm(directions[weak], axis=0) if weak.any() else np.ones(planes)
    return Dependence(condition, tuple(np.flatnonzero(parts > _PART * parts.max()).tolist()))


def least_norm_moments(response: ComplexArray, influence: ComplexArray) -> ComplexArray:
    """Return the moments of least squares without directions that hardly act, shape (plane,).

    Truncated singular values of planes of size one: directions below 1/15 of the strongest are
    omitted (Hansen, Rank-Deficient and Discrete Ill-Posed Problems, 1998, section 3.2).

    Parameters
    ----------
    response : weighted, shape (row,)
    influence : weighted, shape (row, plane)
    """
    size = _size(influence)
    inverse = np.linalg.pinv(influence / size, rcond=1.0 / DEPENDENT)
    return np.asarray(-(inverse @ response) / size)


def without_plane(response: ComplexArray, influence: ComplexArray, plane: int) -> ComplexArray:
    """Return the moments of least squares with no weight in a plane, shape (plane,).

    Parameters
    ----------
    response : weighted, shape (row,)
    influence : weighted, shape (row, plane)
    plane : number of the plane
    """
    moment = np.zeros(influence.shape[1], dtype=complex)
    others = np.arange(influence.shape[1]) != plane
    moment[others] = least_squares_moments(response[None], influence[None][..., others])
    return moment


def sound_moments(response: ComplexArray, influence: ComplexArray) -> ComplexArray:
    """Return the answer with the least sum of squares of those without dependent planes, (plane,).

    These are the answer of least norm, and those with a plane omitted whose other planes are
    independent; the ones of least squares where all planes are independent.

    Parameters
    ----------
    response : weighted, shape (row,)
    influence : weighted, shape (row, plane)
    """
    related = dependence(influence).planes
    if not related:
        return least_squares_moments(response[None], influence[None])
    answers = [least_norm_moments(response, influence)]
    answers += [
        without_plane(response, influence, plane)
        for plane in related * (influence.shape[1] > 1)
        if not dependence(np.delete(influence, plane, axis=1)).planes
    ]
    return min(answers, key=lambda moment: float(np.linalg.norm(response + influence @ moment)))


def _size(influence: ComplexArray) -> Array:
    """Size of each plane's influence, one where it has none, shape (plane,)."""
    size = np.linalg.norm(influence, axis=0)
    return np.where(size > 0.0, size, 1.0)
