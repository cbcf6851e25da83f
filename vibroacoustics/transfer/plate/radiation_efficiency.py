"""Radiation efficiency of bending waves of a plate."""

import numpy as np

from ...base.arrays import Array
from ...base.constants import SPEED_OF_SOUND_M_PER_S

LARGEST = 2.0
"""Largest radiation efficiency (EN 12354-1, B.2)."""


def radiation_efficiency(
    frequency_hz: Array, coincidence_hz: float, size_m: tuple[float, float] | None
) -> Array:
    """Radiation efficiency σ of free bending waves to one side of a plate in a wall.

    Finite: mean over the modes after Maidanik, J. Acoust. Soc. Am. 34 (1962) 809, and Leppington,
    Broadbent and Heron, Proc. R. Soc. A 382 (1982) 245, put together as in EN 12354-1:2000, B.2.
    Without end: 1/√(1 - f_c/f) above coincidence, nothing below it.

    Parameters
    ----------
    frequency_hz : above zero, shape (...)
    coincidence_hz : f_c
    size_m : length and width; none of a plate without end

    Returns
    -------
    shape (...), up to LARGEST
    """
    frequency = np.asarray(frequency_hz, dtype=float)
    above = np.sqrt(1.0 / np.maximum(1.0 - coincidence_hz / frequency, LARGEST**-2))
    if size_m is None:
        return np.where(frequency > coincidence_hz, above, 0.0)
    length, width = size_m
    c, area = SPEED_OF_SOUND_M_PER_S, length * width
    first_hz = c**2 / (4.0 * coincidence_hz) * (1.0 / length**2 + 1.0 / width**2)
    as_piston = 4.0 * area * (frequency / c) ** 2
    as_edge = np.sqrt(2.0 * np.pi * frequency * (length + width) / (16.0 * c))
    if first_hz > coincidence_hz / 2.0:
        below_hz = frequency < coincidence_hz
        least = np.where(below_hz, np.minimum(as_piston, as_edge), np.minimum(above, as_edge))
        return np.asarray(np.minimum(least, LARGEST))
    below = _edges_and_corners(frequency, coincidence_hz, length, width)
    below = np.where(frequency < first_hz, np.minimum(below, as_piston), below)
    return np.asarray(np.minimum(np.where(frequency >= coincidence_hz, above, below), LARGEST))


def _edges_and_corners(
    frequency: Array, coincidence_hz: float, length_m: float, width_m: float
) -> Array:
    """Radiation efficiency below coincidence: strips along the edges and, below half of it,
    corners."""
    c, area = SPEED_OF_SOUND_M_PER_S, length_m * width_m
    ratio = np.clip(np.sqrt(frequency / coincidence_hz), 1e-6, 1.0 - 1e-9)
    complement = 1.0 - ratio**2
    edges = (complement * np.log((1.0 + ratio) / (1.0 - ratio)) + 2.0 * ratio) / (
        4.0 * np.pi**2 * complement**1.5
    )
    corners = 8.0 * c**2 * (1.0 - 2.0 * ratio**2) / (
        coincidence_hz**2 * np.pi**4 * area * ratio * np.sqrt(complement)
    )  # fmt: skip
    corners = np.where(frequency < coincidence_hz / 2.0, corners, 0.0)
    return np.asarray(2.0 * (length_m + width_m) / area * c / coincidence_hz * edges + corners)
