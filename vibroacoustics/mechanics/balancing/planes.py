"""Planes that act alike, and weights in their holes."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from .moments import chosen_moments, least_squares_moments

_TURN: Final = 2.0 * np.pi
_SAME_RAD: Final = 1e-9


class Piece(NamedTuple):
    """Weight in a hole, or at any angle where a plane has no holes.

    Attributes
    ----------
    hole : number of the hole, from one; none without holes
    moment : magnitude of its moment, kg m
    angle_rad : angle from the zero of the plane
    """

    hole: int | None
    moment: float
    angle_rad: float

    @property
    def vector(self) -> complex:
        """Moment at its angle."""
        return complex(self.moment * np.exp(1j * self.angle_rad))


def split_moment(moment: complex, angle_rad: Array) -> list[Piece]:
    """Split a moment between the two holes beside its angle.

    m₁ = m sin(θ₂ - θ)/sin(θ₂ - θ₁) and m₂ = m sin(θ - θ₁)/sin(θ₂ - θ₁); a hole at the angle itself
    takes all. Holes that are 180° or more apart cannot make it: the moment along the nearer one is
    what is possible.

    Parameters
    ----------
    moment : mass times radius at an angle, kg m
    angle_rad : angles of the holes, shape (hole,); empty for any angle
    """
    size, angle = abs(moment), float(np.angle(moment))
    if size == 0.0 or len(angle_rad) == 0:
        return [Piece(None, size, angle)] if size else []
    ahead = (angle_rad - angle + _SAME_RAD) % _TURN - _SAME_RAD
    behind = (angle - angle_rad + _SAME_RAD) % _TURN - _SAME_RAD
    after, before = int(np.argmin(ahead)), int(np.argmin(behind))
    gap = float(ahead[after] + behind[before])
    if ahead[after] <= _SAME_RAD or gap >= np.pi - _SAME_RAD:
        nearest = int(np.argmin(np.minimum(ahead, behind)))
        along = size * np.cos(min(ahead[nearest], behind[nearest]))
        return [Piece(nearest + 1, float(along), float(angle_rad[nearest]))] * bool(along > 0.0)
    shares = {before: np.sin(ahead[after]), after: np.sin(behind[before])}
    parts = {hole: float(size * share / np.sin(gap)) for hole, share in shares.items()}
    return [
        Piece(hole + 1, part, float(angle_rad[hole]))
        for hole, part in sorted(parts.items())
        if part > _SAME_RAD * size
    ]


def positions(angle_rad: Array, moments: Array) -> list[Piece]:
    """Return every single weight that fits a hole, and none first.

    Parameters
    ----------
    angle_rad : angles of the holes, shape (hole,)
    moments : moments of the masses that are available, kg m, shape (mass,)
    """
    pieces = [
        Piece(hole + 1, float(moment), float(angle))
        for moment in moments
        for hole, angle in enumerate(angle_rad)
    ]
    return [Piece(None, 0.0, 0.0), *pieces]


def chosen_pieces(
    response: ComplexArray, influence: ComplexArray, choices: Sequence[Sequence[Piece]]
) -> list[Piece]:
    """Return the piece of each plane with the least worst sum of squares; see `chosen_moments`.

    Parameters
    ----------
    response, influence : see `sums_of_squares`
    choices : pieces that fit each plane
    """
    vectors = [np.array([piece.vector for piece in pieces]) for pieces in choices]
    numbers = chosen_moments(response, influence, vectors)
    return [pieces[number] for pieces, number in zip(choices, numbers.tolist(), strict=True)]


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
