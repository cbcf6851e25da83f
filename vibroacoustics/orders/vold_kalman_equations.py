"""Equations of the Vold-Kalman filter: structural and data equations of B-spline envelopes.

The normal equations are kept as the lower band that scipy.linalg.cholesky_banded takes. Unknowns
by spline, track, and real and imaginary part.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import comb
from typing import Final

import numpy as np

from ..base.arrays import Array
from .crank_motion import CrankMotion

SUPPORT: Final = 4
"""Cubic B-splines that overlap at a time."""
_CHUNK: Final = 1 << 16
"""Samples at a time: bounds the memory."""
_UNTHREADED: Final = 1 << 18
"""Multiplications of a matrix product that OpenBLAS leaves to one thread. With more it starts
threads, and on busy cores they wait for each other: up to hundreds of times as long."""


@dataclass(frozen=True)
class Track:
    """An order of a shaft to be tracked."""

    motion: CrankMotion
    order: float


def weight_squared(bandwidth_hz: float, sample_rate_hz: float, poles: int) -> float:
    """r² of the structural equation for a -3 dB bandwidth (Tůma 2005, ICSV12 Lisbon).

    r² = (√2 - 1) / (2 - 2 cos(π B/f_s))^p, in closed form for every p; for p = 1, 2, 3 the
    denominators are 2 - 2 cos, 6 - 8 cos + 2 cos 2 and 20 - 30 cos + 12 cos 2 - 2 cos 3.
    """
    step = 2.0 * np.sin(0.5 * np.pi * bandwidth_hz / sample_rate_hz)
    return float((np.sqrt(2.0) - 1.0) / step ** (2 * poles))


def structural_equations(splines: int, unknowns: int, weight: float, poles: int) -> Array:
    """Weighted squares of the p-th differences, lower band of the normal equations."""
    band = np.zeros((SUPPORT * unknowns, splines * unknowns))
    difference = [(-1) ** i * comb(poles, i) for i in range(poles + 1)]
    rows = (splines - poles) * unknowns
    for i in range(poles + 1):
        for j in range(i + 1):
            start = j * unknowns
            band[(i - j) * unknowns, start : start + rows] += weight * difference[i] * difference[j]
    return band


def data_pieces(
    channels: Array, tracks: Sequence[Track], first: int, sample_rate_hz: float, step: int
) -> Iterator[tuple[int, Array, Array]]:
    """First knot, design matrices (knot, spline and unknown, sample) and samples, piece by piece.

    For one unknown pair, Re{X exp(jΘ)} = Re X cos Θ - Im X sin Θ.
    """
    shape = _cubic_splines(step)
    count = channels.shape[-1]
    length = max(1, _CHUNK // step) * step
    for begin in range(0, count, length):
        size = min(length, count - begin)
        knots = -(-size // step)
        time = (first + begin + np.arange(size)) / sample_rate_hz
        carrier = np.zeros((2 * len(tracks), knots * step))
        for number, track in enumerate(tracks):
            angle = track.order * track.motion.angle_rad(time)
            carrier[2 * number, :size] = np.cos(angle)
            carrier[2 * number + 1, :size] = -np.sin(angle)
        samples = np.zeros((channels.shape[0], knots * step))
        samples[:, :size] = channels[:, begin : begin + size]
        by_knot = carrier.reshape(-1, knots, step).transpose(1, 0, 2)
        design = (shape[:, None, :] * by_knot[:, None]).reshape(knots, -1, step)
        yield begin // step, design, samples.reshape(-1, knots, step).transpose(1, 2, 0)


def _cubic_splines(step: int) -> Array:
    """The four uniform cubic B-splines between two knots, shape (4, step)."""
    w = np.arange(step) / step
    after = 1.0 + 3.0 * w * (1.0 + w - w**2)
    return np.stack([(1.0 - w) ** 3, 4.0 - 6.0 * w**2 + 3.0 * w**3, after, w**3]) / 6.0


def add_data_equations(
    band: Array,
    right: Array,
    start: int,
    unknowns: int,
    design: Array,
    samples: Array,
    scale: float,
) -> None:
    """Add a piece to the lower band of the normal equations and to their right-hand sides."""
    knots, rows, step = design.shape
    products = np.zeros((knots, rows, rows))
    projections = np.zeros((knots, rows, samples.shape[-1]))
    length = max(1, _UNTHREADED // rows**2)
    for part in range(0, step, length):
        piece = design[..., part : part + length]
        products += scale * (piece @ piece.transpose(0, 2, 1))
        projections += scale * (piece @ samples[:, part : part + length])
    for i in range(rows):
        column = slice(start * unknowns + i, (start + knots) * unknowns + i, unknowns)
        right[column] += projections[:, i]
        for j in range(i + 1):
            column = slice(start * unknowns + j, (start + knots) * unknowns + j, unknowns)
            band[i - j, column] += products[:, i, j]
