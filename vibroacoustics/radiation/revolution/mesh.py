"""Elements on a meridian: short towards edges, with Gauss points as nodes."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial import chebyshev, legendre

from ...base.revolution import Curve, Profile
from ..arrays import Array
from .profile import edges

NODES: Final = 5
"""Nodes of an element: pressure and velocity are polynomials of degree four along it."""
_DEGREE: Final = 7
"""Degree of the polynomials that stand for the curve of an element."""
_FITTING: Final = 1e-6
"""Largest distance of an element from its curve over half of its length."""
_SHRINKING: Final = 0.3
"""Length of an element next to an edge over that of the two it was, for each grading."""


@dataclass(frozen=True)
class Mesh:
    """Elements of a meridian from bottom to top."""

    coefficients: Array
    """Radius and height as polynomials of the local coordinate -1 to 1, (element, 2, power), m."""
    points: Array
    """Radius and height of the nodes, (node, 2), m; element by element."""
    normals: Array
    """Unit normals out of the body, (node, 2)."""
    weights: Array
    """Length that each node stands for, (node,), m."""

    @property
    def lengths(self) -> Array:
        """Length of each element, m."""
        return np.asarray(self.weights.reshape(-1, NODES).sum(axis=1))

    def depth_m(self, points: Array) -> Array:
        """Distance of points (point, 2) from the nodes, m; negative outside the body."""
        gap = points[:, None] - self.points
        distance = np.linalg.norm(gap, axis=2)
        nearest = np.argmin(distance, axis=1)
        rows = np.arange(len(points))
        facing = np.einsum("pi,pi->p", gap[rows, nearest], self.normals[nearest])
        return np.asarray(-np.sign(facing) * distance[rows, nearest])


def mesh(profile: Profile, longest_m: float, gradings: int) -> Mesh:
    """Elements of at most a length, with some gradings towards each edge of the profile."""
    coefficients = np.concatenate(
        [
            _elements(curve, longest_m, *(gradings * int(edge) for edge in ends))
            for curve, ends in zip(profile.curves, edges(profile), strict=True)
        ]
    )
    local, gauss = legendre.leggauss(NODES)
    powers = np.arange(_DEGREE + 1)
    values = local[:, None] ** powers
    slopes = powers * local[:, None] ** np.maximum(powers - 1, 0)
    points = np.einsum("eip,np->eni", coefficients, values).reshape(-1, 2)
    tangents = np.einsum("eip,np->eni", coefficients, slopes).reshape(-1, 2)
    speed = np.linalg.norm(tangents, axis=1)
    normals = np.stack([tangents[:, 1], -tangents[:, 0]], axis=1) / speed[:, None]
    return Mesh(coefficients, points, normals, np.tile(gauss, len(coefficients)) * speed)


def _elements(curve: Curve, longest_m: float, at_start: int, at_end: int) -> Array:
    """Polynomials (element, 2, power) of one curve."""
    fine = curve(np.linspace(0.0, 1.0, 401))
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))])
    shares = _breaks(run[-1], longest_m, at_start, at_end)
    breaks = np.interp(shares * run[-1], run, np.linspace(0.0, 1.0, 401))
    elements = [
        element for start, stop in pairwise(breaks) for element in _fitted(curve, start, stop)
    ]
    return np.array(elements)


def _fitted(curve: Curve, start: float, stop: float) -> list[Array]:
    """Polynomials (2, power) of a part of a curve, of its halves where one does not follow it."""
    nodes = chebyshev.chebpts1(_DEGREE + 1)
    between = np.linspace(-1.0, 1.0, 2 * _DEGREE + 1)
    middle, half = (start + stop) / 2.0, (stop - start) / 2.0
    element = np.linalg.solve(np.vander(nodes, increasing=True), curve(middle + half * nodes))
    exact = curve(middle + half * between)
    beside = np.vander(between, _DEGREE + 1, increasing=True) @ element - exact
    if np.abs(beside).max() > _FITTING * np.linalg.norm(element[1]):
        return [*_fitted(curve, start, middle), *_fitted(curve, middle, stop)]
    return [element.T]


def _breaks(length_m: float, longest_m: float, at_start: int, at_end: int) -> Array:
    """Ends of the elements along a curve, 0 to 1."""
    number = max(int(np.ceil(length_m / longest_m)), 1 + int(at_start > 0 and at_end > 0))
    breaks = np.linspace(0.0, 1.0, number + 1)
    first = breaks[1] * _SHRINKING ** np.arange(at_start, 0, -1)
    last = 1.0 - breaks[1] * _SHRINKING ** np.arange(1, at_end + 1)
    return np.asarray(np.concatenate([breaks[:1], first, breaks[1:-1], last, breaks[-1:]]))
