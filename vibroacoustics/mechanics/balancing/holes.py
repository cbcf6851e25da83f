"""Weights in holes: a moment split between neighbours, or chosen among whole masses."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from .moments import chosen_moments

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
