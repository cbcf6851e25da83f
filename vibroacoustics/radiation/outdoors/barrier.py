"""A thin upright barrier without ends."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.decibel import amplitude_of_level, level_of_amplitude
from ..arrays import Array, ComplexArray

_MOST_DB: Final = 24.0
"""That barriers take off in practice (Kurze and Anderson)."""
_CLEAR: Final = -0.19
"""Fresnel number from which on the edge does nothing; there the formula passes 0 dB."""


@dataclass(frozen=True)
class Barrier:
    """A screen across an axis.

    Attributes
    ----------
    axis, sign : that it stands across, and on which side of the machine
    position_m : on that axis
    top_m : height of its edge, z
    """

    axis: int
    sign: int
    position_m: float
    top_m: float

    def hides(self, point: Array) -> bool:
        """Whether a point (3,) lies behind it."""
        return bool(self.sign * (point[self.axis] - self.position_m) > 0.0)

    def edge_points(self, points: Array, receiver: Array) -> Array:
        """Where the shortest way from points (point, 3) to a receiver crosses the edge."""
        before, behind = self._to_edge(points), self._to_edge(receiver)
        edge = points + (receiver - points) * (before / (before + behind))[..., None]
        edge[..., self.axis], edge[..., 2] = self.position_m, self.top_m
        return np.asarray(edge)

    def wave(self, points: Array, receiver: Array, wavenumber: float) -> ComplexArray:
        """Green's function over the edge, 1/m, (point,): free field, attenuated and late.

        Size of the free field by the attenuation, phase of the way over the edge where that hides
        the receiver (Lam, J. Acoust. Soc. Am. 95 (1994) 2403).
        """
        direct = np.linalg.norm(receiver - points, axis=-1)
        edge = self.edge_points(points, receiver)
        over = np.linalg.norm(edge - points, axis=-1) + np.linalg.norm(receiver - edge, axis=-1)
        share = self._gap(points) / (self._gap(points) + self._gap(receiver))
        hidden = points[..., 2] + share * (receiver[2] - points[..., 2]) < self.top_m
        fresnel = np.where(hidden, 1.0, -1.0) * wavenumber * (over - direct) / np.pi
        loss_db = attenuation_db(fresnel).astype(np.float64)
        size = 1.0 / (4.0 * np.pi * direct * amplitude_of_level(loss_db))
        return np.asarray(size * np.exp(-1j * wavenumber * np.where(hidden, over, direct)))

    def _gap(self, points: Array) -> Array:
        return np.asarray(np.abs(points[..., self.axis] - self.position_m))

    def _to_edge(self, points: Array) -> Array:
        return np.asarray(np.hypot(self._gap(points), points[..., 2] - self.top_m))


def attenuation_db(fresnel: Array) -> Array:
    """5 dB + 20 lg(√(2πN)/tanh √(2πN)), N Fresnel number; below zero with tan, where it is clear.

    Kurze and Anderson, Appl. Acoust. 4 (1971) 35, after Maekawa's chart; at most 24 dB.

    Parameters
    ----------
    fresnel : N = 2 (way over the edge - direct way)/λ, negative where the edge is below the line
    """
    number = np.clip(np.asarray(fresnel, dtype=float), _CLEAR, None)
    root = np.sqrt(2.0 * np.pi * np.maximum(np.abs(number), 1e-12))
    turn = np.where(number > 0.0, np.tanh(root), np.tan(np.minimum(root, 1.5)))
    level = 5.0 + level_of_amplitude(np.asarray(root / turn))
    return np.asarray(np.clip(np.where(fresnel > _CLEAR, level, 0.0), 0.0, _MOST_DB))
