"""Periodic cubic splines of equal pieces over one turn, for compiled equations of motion.

Coefficients are those of scipy's `CubicSpline`, shape (4, pieces), the highest power first.
"""

import numba
import numpy as np

from .arrays import Array


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def piece_and_step(pieces: int, angle: float) -> tuple[int, float]:
    """Number of the piece that holds an angle, and how far it is from its start, rad."""
    turn = angle / (2.0 * np.pi)
    position = (turn - np.floor(turn)) * pieces
    piece = min(int(position), pieces - 1)
    return piece, (position - piece) * (2.0 * np.pi / pieces)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def spline_value(spline: Array, angle: float) -> float:
    """Value of a spline at an angle, rad."""
    piece, step = piece_and_step(spline.shape[1], angle)
    value = spline[0, piece]
    for power in range(1, 4):
        value = value * step + spline[power, piece]
    return float(value)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def value_and_slope(spline: Array, angle: float) -> tuple[float, float]:
    """Value and slope of a spline at an angle, rad."""
    piece, step = piece_and_step(spline.shape[1], angle)
    value, slope = 0.0, 0.0
    for power in range(4):
        slope = slope * step + value
        value = value * step + spline[power, piece]
    return value, slope
