"""Smooth curve through noisy points, as smooth as the points themselves ask for."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import BSpline, CubicSpline, PPoly
from scipy.linalg import solveh_banded

from ..base.arrays import Array

_INFLATION: Final = 1.4
"""Factor of the degrees of freedom in the criterion: without it, far too many are chosen at times
(Kim and Gu 2004)."""

_CLEAN_TRIALS: Final = 8
"""Pieces after the third trial: fewer trials cannot distinguish a clean curve from luck."""


@dataclass(frozen=True)
class SmoothCurve:
    """Cubic spline with the scatter of the points about it."""

    curve: PPoly
    scatter: float
    """Standard deviation of the points' noise; zero where the curve goes through them."""


def smooth_curve(x: Array, y: Array) -> SmoothCurve:
    """Least-squares cubic spline whose number of knots generalised cross-validation chooses.

    Least of V(p) = n RSS / (n - 1.4 p)² over p coefficients (Craven and Wahba, Numerische
    Mathematik 31, 1979; the factor from Kim and Gu, Journal of the Royal Statistical Society B 66,
    2004). The knots lie at every n-th point, twice as many from one trial to the next. Where the
    trial with most of them, up to one at every other point, is best of three or more, the points
    are clean and the curve goes through them; so it does through fewer than eight.

    Parameters
    ----------
    x : shape (points,), rising
    y : shape (points,)
    """
    best, least, pieces = None, np.inf, 1
    while (size := pieces + 3) <= x.size // 2:
        spline = _least_squares(x, y, pieces)
        squares = float(np.sum((y - spline(x)) ** 2))
        criterion = x.size * squares / (x.size - _INFLATION * size) ** 2
        if criterion < least:
            best, least, scatter = spline, criterion, np.sqrt(squares / (x.size - size))
        pieces *= 2
    if best is None or (pieces >= _CLEAN_TRIALS and best.c.size == pieces // 2 + 3):
        curve = CubicSpline(x, y)
        return SmoothCurve(PPoly(curve.c, curve.x), 0.0)
    curve = PPoly.from_spline(best)
    return SmoothCurve(PPoly(curve.c[:, 3:-3], curve.x[3:-3]), float(scatter))


def _least_squares(x: Array, y: Array, pieces: int) -> BSpline:
    """Cubic spline of so many pieces, from the banded normal equations of its B-splines."""
    breaks = x[np.linspace(0, x.size - 1, pieces + 1).round().astype(int)]
    knots = np.concatenate([[x[0]] * 3, breaks, [x[-1]] * 3])
    design = BSpline.design_matrix(x, knots, 3)
    values, first = design.data.reshape(-1, 4), design.indices[::4]
    size = pieces + 3
    band, right = np.zeros((4, size)), np.zeros(size)
    for i in range(4):
        right += np.bincount(first + i, values[:, i] * y, minlength=size)
        for j in range(i, 4):
            band[j - i] += np.bincount(first + i, values[:, i] * values[:, j], minlength=size)
    return BSpline(knots, solveh_banded(band, right, lower=True), 3)
