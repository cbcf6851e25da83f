"""Levels in decibels: of tones, of mean squares, sums and differences."""

from typing import Final

import numpy as np

from .arrays import Array, ComplexArray
from .constants import REFERENCE_PRESSURE_PA
from .errors import ParameterError

SILENCE_DB: Final = -300.0
"""Level that stands for no sound at all: finite, so that tables and sums stay numbers."""


def sound_pressure_level(pressure_peak_pa: ComplexArray | Array | float) -> Array:
    """Level of a tone from its (complex) peak pressure: 20 lg(|P| / √2 / 20 µPa), dB."""
    effective = np.abs(pressure_peak_pa) / np.sqrt(2.0)
    floor = REFERENCE_PRESSURE_PA * 10.0 ** (SILENCE_DB / 20.0)
    return np.asarray(20.0 * np.log10(np.maximum(effective, floor) / REFERENCE_PRESSURE_PA))


def mean_square_level(mean_square: Array | float, reference: float) -> Array:
    """Level of a signal's mean square: 10 lg(x² / x_0²), dB; SILENCE_DB at least.

    Raises
    ------
    ParameterError
        The mean square is not finite.
    """
    if not np.all(np.isfinite(mean_square)):
        raise ParameterError("signal: holds values that are not finite numbers")
    relative = np.asarray(mean_square) / reference**2
    return np.asarray(10.0 * np.log10(np.maximum(relative, 10.0 ** (SILENCE_DB / 10.0))))


def energy_sum(level_db: Array, axis: int | tuple[int, ...]) -> Array:
    """Level of the sum of incoherent sounds: 10 lg Σ 10^(L/10), dB."""
    power = np.sum(10.0 ** (np.asarray(level_db) / 10.0), axis=axis)
    return np.asarray(10.0 * np.log10(np.maximum(power, 10.0 ** (SILENCE_DB / 10.0))))


def energy_difference(total_db: float, part_db: float) -> float:
    """Level that is left when a part is taken out of a total: 10 lg(10^(T/10) - 10^(P/10)), dB.

    Raises
    ------
    ValueError
        The part is at least as loud as the total.
    """
    if part_db >= total_db:
        raise ValueError(f"part of {part_db:.2f} dB is not below the total of {total_db:.2f} dB")
    return float(total_db + 10.0 * np.log10(1.0 - 10.0 ** ((part_db - total_db) / 10.0)))
