"""Likelihood of orders of a shaft over candidates of its speed; smooth curves through points."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.fft import rfft
from scipy.interpolate import BSpline, CubicSpline, PPoly
from scipy.linalg import solveh_banded
from scipy.ndimage import map_coordinates, median_filter
from scipy.sparse import csr_array

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


_NOISE_LEVEL: Final = 0.5963473623231941
"""Mean of ln(1 + p) for the power p of white noise, exponentially distributed: e E1(1)."""
_BETWEEN: Final = np.array([1.0, 1.5, 2.0]) / 3.0
"""Orders of the comb between two teeth. Twice the shaft's speed leaves lines at a half, three
times at a third and two thirds: without them these speeds would explain rich spectra as well."""
_DYNAMIC_RANGE: Final = 1e-12
"""Least floor over the strongest line: 120 dB, more than a 24-bit converter has."""
_SEARCH: Final = 12
"""Candidates to each side over which the speed is refined."""
_CLEAR_LINE: Final = 10.0
"""Power over the floor from which a line counts in full: noise gets there in one bin of 20000."""
_STEEPEST: Final = 0.5
"""Largest share by which the speed of a straightened frame may change to each side."""


def frame_levels(
    signal: Array, centres: Array, length: int, change_per_sample: Array, floor_bins: int
) -> Array:
    """Spectra of frames that are straightened to an even speed, over their noise floor.

    Time is warped so that a shaft whose speed changes linearly turns evenly (fan-chirp transform:
    Weruaga and Kepesi, Signal Processing 87, 2007). The floor is the running median over frequency,
    of which Hann lines fill less than half.

    Parameters
    ----------
    signal : shape (time,)
    centres : shape (frames,), in samples
    length : length of a frame, samples; the spectrum has twice that length
    change_per_sample : shape (frames,), relative change of speed at the centre
    floor_bins : width of the running median

    Returns
    -------
    shape (frames, length + 1): ln(1 + power over floor), less its mean in noise
    """
    angle = np.arange(length) - 0.5 * (length - 1)
    window = 0.5 + 0.5 * np.cos(2.0 * np.pi * angle / length)
    bound = 2.0 * _STEEPEST / length
    levels = np.empty((centres.size, length + 1))
    for row, centre, change in zip(
        levels, centres, np.clip(change_per_sample, -bound, bound), strict=True
    ):
        sample = centre + 2.0 * angle / (1.0 + np.sqrt(1.0 + 2.0 * change * angle))
        power = np.abs(rfft(window * _at(signal, sample), 2 * length)) ** 2
        least = _DYNAMIC_RANGE * power.max() + np.finfo(float).tiny
        floor = median_filter(power, floor_bins, mode="nearest") / np.log(2.0)
        row[:] = np.log1p(power / np.maximum(floor, least)) - _NOISE_LEVEL
    return levels


def comb_scores(levels: Array, orders: Array, candidates: Array) -> Array:
    """Sum of the levels at the orders of each candidate, less the mean level between them.

    A sum of log spectra over the orders is the logarithm of the joint probability of a speed
    (Leclere, Andre and Antoni, Mechanical Systems and Signal Processing 81, 2016).

    Parameters
    ----------
    levels : shape (frames, bins), from `frame_levels`
    orders : shape (orders,), rising
    candidates : shape (candidates,), speeds in bins

    Returns
    -------
    shape (frames, candidates), about the logarithm of a likelihood ratio against noise
    """
    below = np.concatenate([[0.0], orders[:-1]])
    between = (below[:, None] + _BETWEEN * (orders - below)[:, None]).ravel()
    weight = np.repeat([1.0, -1.0 / _BETWEEN.size], [orders.size, between.size])
    bins_of_comb = np.concatenate([orders, between])[:, None] * candidates
    covered = bins_of_comb < levels.shape[1] - 1
    lower, column = np.floor(bins_of_comb[covered]).astype(int), np.nonzero(covered)[1]
    share, tooth = (
        bins_of_comb[covered] - lower,
        np.broadcast_to(weight[:, None], bins_of_comb.shape)[covered],
    )
    comb = csr_array(
        (
            np.concatenate([tooth * (1.0 - share), tooth * share]),
            (np.tile(column, 2), np.concatenate([lower, lower + 1])),
        ),
        shape=(candidates.size, levels.shape[1]),
    )
    return np.asarray((comb @ levels.T).T)


def refine(levels: Array, orders: Array, candidates: Array, path: NDArray[np.int64]) -> Array:
    """Speed at which the lines near each frame's candidate fit best, in bins.

    Largest sum of ln(1 + (p/10)²) over the orders, p the power over the floor. The plain sum of the
    powers is what maximum likelihood asks for in white noise (Quinn and Thomson, Biometrika 78,
    1991), but one strange line, such as mains hum, then pulls the speed along; here each clear line
    counts with the square of its order, and noise hardly at all.

    Parameters
    ----------
    levels, orders, candidates : see `comb_scores`; the candidates in even ratios
    path : shape (frames,), position among the candidates
    """
    ratio = candidates[1] / candidates[0]
    trial = candidates[path][:, None] * ratio ** np.arange(-_SEARCH, _SEARCH + 1)
    bins_of_comb = orders[:, None, None] * trial
    frame = np.broadcast_to(np.arange(path.size)[:, None], bins_of_comb.shape)
    level = (
        map_coordinates(levels, [frame, bins_of_comb], order=3, cval=-_NOISE_LEVEL) + _NOISE_LEVEL
    )
    total = np.log1p((np.expm1(level) / _CLEAR_LINE) ** 2).sum(axis=0)
    best, row = np.clip(np.argmax(total, axis=1), 1, 2 * _SEARCH - 1), np.arange(path.size)
    below, top, right = (total[row, best + offset] for offset in (-1, 0, 1))
    curvature = np.minimum(below - 2.0 * top + right, -1e-9)  # flat where a frame is silent
    shift = np.clip(0.5 * (below - right) / curvature, -1.0, 1.0)
    return np.asarray(trial[row, best] * ratio**shift)


def _at(signal: Array, position: Array) -> Array:
    """Signal between its samples; its first and last value beyond them."""
    position = np.clip(position, 0.0, signal.size - 1.000001)
    lower = position.astype(int)
    share = position - lower
    return np.asarray(signal[lower] * (1.0 - share) + signal[lower + 1] * share)
