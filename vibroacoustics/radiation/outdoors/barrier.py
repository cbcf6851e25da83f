"""A thin upright barrier without ends."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.special import hankel2e, wofz

from ..arrays import Array, ComplexArray

_HANKEL: Final = (3.0 / 8.0, -15.0 / 128.0, 105.0 / 1024.0, -4725.0 / 32768.0)
"""Coefficients of the asymptotic series of the Hankel function of order one."""

_SERIES_FROM: Final = 8.0
"""Argument kL from which the series is within 0.03 dB."""
_RULE: Final = np.polynomial.legendre.leggauss(13)
_LENGTH: Final = 3.1
"""Nodes and length of the quadrature, within 0.001 dB below it."""


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
        """Return where the shortest path from points (point, 3) to a receiver crosses the edge."""
        before, behind = self._to_edge(points), self._to_edge(receiver)
        edge = points + (receiver - points) * (before / (before + behind))[..., None]
        edge[..., self.axis], edge[..., 2] = self.position_m, self.top_m
        return np.asarray(edge)

    def wave(self, points: Array, receiver: Array, wavenumber: float) -> ComplexArray:
        """Return Green's function from points to a receiver behind the hard half plane, 1/m.

        Direct sound where the receiver is visible over the edge, less what the edge diffracts of
        it and of the image of the points in the screen (MacDonald's integrals; Bowman, Senior,
        Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes, 1969, section 8.2).

        Parameters
        ----------
        points : positions before the screen, shape (point, 3), m
        receiver : position behind it, shape (3,), m
        wavenumber : ω/c, rad/m
        """
        direct = np.linalg.norm(receiver - points, axis=-1)
        mirrored = points.copy()
        mirrored[..., self.axis] = 2.0 * self.position_m - points[..., self.axis]
        reflected = np.linalg.norm(receiver - mirrored, axis=-1)
        edge = self.edge_points(points, receiver)
        around_edge = np.linalg.norm(edge - points, axis=-1) + np.linalg.norm(
            receiver - edge, axis=-1
        )
        share = self._gap(points) / (self._gap(points) + self._gap(receiver))
        visible = points[..., 2] + share * (receiver[2] - points[..., 2]) > self.top_m
        of_direct = diffracted(wavenumber, direct, around_edge)
        free = np.exp(-1j * wavenumber * direct) / (4.0 * np.pi * direct)
        over_edge = np.where(visible, free - of_direct, of_direct)
        return np.asarray(over_edge + diffracted(wavenumber, reflected, around_edge))

    def _gap(self, points: Array) -> Array:
        return np.asarray(np.abs(points[..., self.axis] - self.position_m))

    def _to_edge(self, points: Array) -> Array:
        return np.asarray(np.hypot(self._gap(points), points[..., 2] - self.top_m))


def diffracted(wavenumber: float, distance_m: Array, over_m: Array) -> ComplexArray:
    """Return the sound that the edge of a hard half plane sends into a shadow, 1/m.

    -jk/(4π) ∫_m^∞ H1(kR + s²)/√(s² + 2kR) ds with the Hankel function of the second kind and
    m² = k (L - R); within 0.03 dB for every kL.

    Parameters
    ----------
    wavenumber : k, rad/m
    distance_m : R from source or image to receiver, shape (point,), m
    over_m : L, shortest path over the edge, shape (point,), m
    """
    near, far = wavenumber * distance_m, wavenumber * np.maximum(over_m, distance_m)
    low = far < _SERIES_FROM
    integral = np.empty(far.shape, dtype=complex)
    integral[low] = _by_quadrature(near[low], far[low])
    integral[~low] = _by_series(near[~low], far[~low])
    return np.asarray(-1j * wavenumber / (4.0 * np.pi) * integral)


def _by_quadrature(near: Array, far: Array) -> ComplexArray:
    """Integral along s = m + t exp(-jπ/4), on which the integrand falls as exp(-t²)."""
    end, turn = np.sqrt(far - near), np.exp(-0.25j * np.pi)
    length = _LENGTH / (1.0 + 0.25 * end)
    total = np.zeros(far.shape, dtype=complex)
    for node, weight in zip(*_RULE, strict=True):
        square = (end + 0.5 * (1.0 + node) * length * turn) ** 2
        value = hankel2e(1, near + square) * np.exp(-1j * (near + square))
        total += 0.5 * weight * value / np.sqrt(square + 2.0 * near)
    return np.asarray(total * length * turn)


def _by_series(near: Array, far: Array) -> ComplexArray:
    """Integral of exp(-js²) exactly, and of the slow rest by its slope and curvature in s².

    On the edge of the shadow, R = L, it is half of the whole: the rest of the error is taken out.
    """
    exact = 0.5j * np.exp(-1j * far) / far
    return np.asarray(_series(near, far) * exact / _series(far, far))


def _series(near: Array, far: Array) -> ComplexArray:
    square = far - near
    end = np.sqrt(square)
    # Moments of 1, s² and s⁴ with exp(-js²) from m to infinity, over exp(-jm²).
    zeroth = 0.5 * np.sqrt(np.pi) * np.exp(-0.25j * np.pi) * wofz(np.exp(0.75j * np.pi) * end)
    first = (end + zeroth) / 2j
    second = (end**3 + 3.0 * first) / 2j
    series, slope, bend = _hankel_series(far)
    growth = slope / series - 0.5 / far - 0.5 / (far + near)
    curvature = bend / series - (slope / series) ** 2 + 0.5 / far**2 + 0.5 / (far + near) ** 2
    integral = zeroth + growth * (first - square * zeroth)
    integral += 0.5 * (growth**2 + curvature) * (second - 2.0 * square * first + square**2 * zeroth)
    size = np.sqrt(2.0 / (np.pi * far * (far + near))) * np.exp(0.75j * np.pi - 1j * far)
    return np.asarray(size * series * integral)


def _hankel_series(argument: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Asymptotic series of the Hankel function of order one and second kind, and derivatives."""
    terms = [1.0 + 0.0j * argument]
    for number, term in enumerate(_HANKEL, start=1):
        terms.append((-1j) ** number * term * argument**-number)
    orders = range(len(terms))
    slope = sum(-n * term / argument for n, term in zip(orders, terms, strict=True))
    bend = sum(n * (n + 1) * term / argument**2 for n, term in zip(orders, terms, strict=True))
    return np.asarray(sum(terms)), np.asarray(slope), np.asarray(bend)
