"""Answers of a balancing problem: moments to add, by several aims."""

from collections.abc import Mapping, Sequence
from typing import Final, Literal, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...mechanics.balancing.moments import worst_speed_moments
from ...mechanics.balancing.planes import (
    Dependence,
    Piece,
    chosen_pieces,
    dependence,
    least_norm_moments,
    positions,
    sound_moments,
    split_moment,
    without_plane,
)

Aim = Literal["least squares", "least worst"]
SOUND: Final = "independent planes"
LEAST_NORM: Final = "least norm"


class PlaneLimits(NamedTuple):
    """Positions and masses that a plane allows.

    Attributes
    ----------
    angle_rad : angles of the holes, empty for any angle, shape (hole,)
    moments : moments of the masses that are available, empty for any, kg m, shape (mass,)
    largest : largest moment, kg m, infinite for any
    """

    angle_rad: Array
    moments: Array
    largest: float


class BenchProblem(NamedTuple):
    """Readings of the machine with the weights that stay in, and what further weights do.

    Attributes
    ----------
    response : shape (row,)
    influence : shape (row, plane), per kg m
    weight : weight of each row in the aim, shape (row,)
    planes : positions in each plane
    """

    response: ComplexArray
    influence: ComplexArray
    weight: Array
    planes: Sequence[PlaneLimits]

    @property
    def weighted(self) -> tuple[ComplexArray, ComplexArray]:
        """Weighted readings and influence."""
        return self.weight * self.response, self.weight[:, None] * self.influence

    def rows(self, kept: Array) -> "BenchProblem":
        """Problem of some rows.

        Parameters
        ----------
        kept : whether a row is kept, shape (row,)
        """
        return self._replace(
            response=self.response[kept],
            influence=self.influence[kept],
            weight=self.weight[kept],
        )

    def dependence(self) -> Dependence:
        """Find planes that act alike."""
        return dependence(self.weighted[1])

    def moments(self, aim: Aim) -> ComplexArray:
        """Return the best moments within their limits, shape (plane,), kg m."""
        response, influence = self.weighted
        largest = np.array([plane.largest for plane in self.planes])
        if aim == "least squares":
            return worst_speed_moments(response[None], influence[None], largest)
        return worst_speed_moments(response[:, None], influence[:, None], largest)

    def residual(self, moment: ComplexArray) -> ComplexArray:
        """Readings with moments, shape (row,).

        Parameters
        ----------
        moment : shape (plane,), kg m
        """
        return np.asarray(self.response + self.influence @ moment)

    def pieces(self, moment: ComplexArray, aim: Aim) -> list[list[Piece]]:
        """Weights of each plane: split between holes, or the best of the available masses.

        Parameters
        ----------
        moment : shape (plane,), kg m
        aim : aim of the choice among masses
        """
        if not any(len(plane.moments) for plane in self.planes):
            return [
                _split(complex(each), plane)
                for each, plane in zip(moment, self.planes, strict=True)
            ]
        response, influence = self.weighted
        shape = (1, -1) if aim == "least squares" else (-1, 1)
        choices = [
            positions(plane.angle_rad, plane.moments[plane.moments <= plane.largest])
            if len(plane.moments) and each  # a plane without a moment gets no weight
            else [_single(complex(each))]
            for each, plane in zip(moment, self.planes, strict=True)
        ]
        chosen = chosen_pieces(
            response.reshape(shape), influence.reshape(*shape, influence.shape[1]), choices
        )
        pieces = []
        for piece, plane in zip(chosen, self.planes, strict=True):
            any_mass = not len(plane.moments)
            parts = _split(piece.vector, plane) if any_mass else [piece]
            pieces.append([part for part in parts if part.moment > 0.0])
        return pieces


def _split(moment: complex, plane: PlaneLimits) -> list[Piece]:
    """Pieces of a moment in holes, none above the largest of the plane."""
    parts = split_moment(moment, plane.angle_rad)
    top = max((part.moment for part in parts), default=0.0)
    share = min(1.0, plane.largest / top) if top else 1.0
    return [part._replace(moment=share * part.moment) for part in parts]


def _single(moment: complex) -> Piece:
    return Piece(None, abs(moment), float(np.angle(moment)))


def answers_of(
    problem: BenchProblem, names: Sequence[str], groups: Mapping[str, Array]
) -> dict[str, ComplexArray]:
    """Return moments of every aim by its name, each of shape (plane,), kg m.

    Parameters
    ----------
    problem : readings and influence
    names : names of the planes
    groups : whether a row belongs to a kind of sensors, by its name, each of shape (row,)
    """
    answers = {aim: problem.moments(aim) for aim in ("least squares", "least worst")}
    response, influence = problem.weighted
    if problem.dependence().planes:
        answers[SOUND] = _within(sound_moments(response, influence), problem)
        answers[LEAST_NORM] = _within(least_norm_moments(response, influence), problem)
    if len(names) > 1:
        for plane, name in enumerate(names):
            answers[f"without {name}"] = _within(without_plane(response, influence, plane), problem)
    if len(groups) > 1:
        for name, rows in groups.items():
            few = problem.rows(rows)
            is_enough = not few.dependence().planes
            best = few.moments("least squares") if is_enough else least_norm_moments(*few.weighted)
            answers[f"for {name}"] = _within(best, problem)
    return answers


def _within(moment: ComplexArray, problem: BenchProblem) -> ComplexArray:
    """Moments, each at most the largest of its plane."""
    largest = np.array([plane.largest for plane in problem.planes])
    size = np.abs(moment)
    return np.asarray(moment * np.minimum(1.0, largest / np.where(size > 0.0, size, 1.0)))
