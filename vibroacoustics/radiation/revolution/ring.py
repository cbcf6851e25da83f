"""The field of a ring by Fourier orders: Green's function integrated around the axis.

With G = exp(-jkR)/(4 pi R) and R² = d² + 4 r r' sin²(t/2), d the distance in the meridian's plane,
and of its derivative along the ring's normal. Far rings take the midpoint rule, which converges
exponentially; for near ones t = w sinh(u), w = d/sqrt(r r'), moves the poles at R = 0 to
u = ± j pi/2, so that Gauss's rule converges as well, however small d is (Johnston and Elliott,
Int. J. Numer. Meth. Eng. 62 (2005) 564).
"""

from functools import cache
from typing import Any, Final, NamedTuple

import numba
import numpy as np
from numpy.polynomial import legendre

from ..arrays import Array, IndexArray

_MIDPOINTS: Final = (8, 12, 16, 24, 32, 40, 48, 64, 80, 96, 128, 160, 192, 256, 384, 512)
_GAUSS: Final = (8, 12, 16, 20, 24, 28, 32, 40, 48, 64, 80, 96, 128, 160, 192, 256, 384, 512)
DIGITS: Final = 20.0
"""Digits of the rules, as a natural logarithm: 2e-9."""


class Rules(NamedTuple):
    """Rules around the axis, one after the other."""

    midpoints: IndexArray
    """Number of points of each midpoint rule."""
    starts: IndexArray
    cosines: Array
    """Cosines of the orders 0, 1, ... at each point, (point, order)."""
    half_sines: Array
    """Squared sine of half the angle, (point,)."""
    gauss: IndexArray
    """Number of points of each Gauss rule."""
    gauss_starts: IndexArray
    local: Array
    weights: Array


@cache
def rules(orders: int) -> Rules:
    """Rules for the orders 0 to `orders` - 1."""
    angles = np.concatenate([np.pi * (np.arange(n) + 0.5) / n for n in _MIDPOINTS])
    gauss = [legendre.leggauss(n) for n in _GAUSS]
    return Rules(
        np.array(_MIDPOINTS),
        np.cumsum([0, *_MIDPOINTS[:-1]]),
        np.cos(np.multiply.outer(angles, np.arange(orders))),
        np.sin(angles / 2.0) ** 2,
        np.array(_GAUSS),
        np.cumsum([0, *_GAUSS[:-1]]),
        np.concatenate([local for local, _ in gauss]),
        np.concatenate([weights for _, weights in gauss]),
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "nnan", "ninf"})
def ring(
    radius: float, height: float, source: Any, k: float, digits: float, rules: Any, out: Any
) -> None:  # pragma: no cover
    """Write G and its normal derivative by order, (real and imaginary of each, order).

    `source`: radius, height and normal (radial, axial) of the ring. Per unit length of its
    meridian: the factor r' of its circumference is in it.
    """
    across, along = source[0] - radius, source[1] - height
    squared, product = across * across + along * along, radius * source[0]
    facing = source[2] * across + source[3] * along
    leaning = 2.0 * source[2] * radius
    orders = out.shape[1]
    out[:] = 0.0
    width = np.sqrt(squared / product) if product > 0.0 else 1e9
    decay = 2.0 * np.arcsinh(width / 2.0)
    waves = k * min(radius, source[0])
    band = orders + waves
    # Far rings have weak high orders, which the orders folded onto them must not drown.
    margin = max(digits / decay, 0.4 * digits * waves ** (1.0 / 3.0), orders + 8.0 / decay)
    needed = 0.5 * (band + margin)
    split = min(0.5, 10.0 / band)
    reach = np.arcsinh(split / width)
    beyond = 0.5 * (np.pi - split)
    first = digits * (0.35 + 0.11 * reach) + 3.0
    second = 0.5 * band * beyond + digits / np.log(1.0 + 2.0 * np.sqrt(split)) * 0.5 + 4.0
    if needed < 1.2 * (first + second):
        rule = min(np.searchsorted(rules.midpoints, needed), rules.midpoints.size - 1)
        points, start = rules.midpoints[rule], rules.starts[rule]
        for q in range(start, start + points):
            sine = rules.half_sines[q]
            distance = np.sqrt(squared + 4.0 * product * sine)
            _add(out, rules.cosines[q], distance, facing + leaning * sine, k, 1.0)
        out *= source[0] / (2.0 * points)
        return
    cosines = np.empty(orders)
    for part in range(2):
        rule = np.searchsorted(rules.gauss, first if part == 0 else second)
        rule = min(rule, rules.gauss.size - 1)
        points, start = rules.gauss[rule], rules.gauss_starts[rule]
        for q in range(start, start + points):
            if part == 0:
                stretched = 0.5 * reach * (1.0 + rules.local[q])
                angle = width * np.sinh(stretched)
                weight = rules.weights[q] * 0.5 * reach * width * np.cosh(stretched)
            else:
                angle = split + beyond * (1.0 + rules.local[q])
                weight = rules.weights[q] * beyond
            sine = np.sin(0.5 * angle) ** 2
            _cosines(1.0 - 2.0 * sine, cosines)
            distance = np.sqrt(squared + 4.0 * product * sine)
            _add(out, cosines, distance, facing + leaning * sine, k, weight)
    out *= source[0] / (2.0 * np.pi)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _cosines(cosine: float, cosines: Any) -> None:  # pragma: no cover
    cosines[0] = 1.0
    if cosines.size > 1:
        cosines[1] = cosine
    for order in range(2, cosines.size):
        cosines[order] = 2.0 * cosine * cosines[order - 1] - cosines[order - 2]


@numba.njit(
    cache=True,
    nogil=True,
    error_model="numpy",
    inline="always",
)
def _add(
    out: Any, cosines: Any, distance: float, facing: float, k: float, weight: float
) -> None:  # pragma: no cover
    phase = k * distance
    strength = weight / distance
    real, imaginary = strength * np.cos(phase), -strength * np.sin(phase)
    slope = -facing / (distance * distance)
    slope_real = slope * (real - phase * imaginary)
    slope_imaginary = slope * (imaginary + phase * real)
    for order in range(cosines.size):
        cosine = cosines[order]
        out[0, order] += real * cosine
        out[1, order] += imaginary * cosine
        out[2, order] += slope_real * cosine
        out[3, order] += slope_imaginary * cosine
