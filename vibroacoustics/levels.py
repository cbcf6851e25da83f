"""Sound pressure levels: frequency weighting, sums of orders, changes."""

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .constants import REFERENCE_PRESSURE_PA

Real = NDArray[np.float64]

# Pole frequencies of the A and C weightings, Hz (IEC 61672-1:2013, Annex E, from f_r = 1 kHz,
# f_L = 10^1.5 Hz, f_H = 10^3.9 Hz, f_A = 10^2.45 Hz, D = 1/√2).
_F1: Final = 20.598997
_F2: Final = 107.65265
_F3: Final = 737.86223
_F4: Final = 12194.217

SILENCE_DB: Final = -300.0
"""Level that stands for no sound at all: finite, so that tables and sums stay numbers."""


def a_weighting(frequency_hz: Real | float) -> Real:
    """A-weighting in dB at exact frequencies (IEC 61672-1:2013, equation E.6)."""
    return _in_db(_a_gain, frequency_hz)


def c_weighting(frequency_hz: Real | float) -> Real:
    """C-weighting in dB at exact frequencies (IEC 61672-1:2013, equation E.1)."""
    return _in_db(_c_gain, frequency_hz)


def z_weighting(frequency_hz: Real | float) -> Real:
    """No weighting: 0 dB at every frequency."""
    return np.zeros_like(np.asarray(frequency_hz, dtype=float))


WEIGHTING: Final[dict[str, Callable[[Real | float], Real]]] = {
    "Z": z_weighting,
    "A": a_weighting,
    "C": c_weighting,
}


def sound_pressure_level(pressure_peak_pa: NDArray[np.complex128] | Real | float) -> Real:
    """Level of a tone from its (complex) peak pressure: 20 lg(|P| / √2 / 20 µPa), dB."""
    effective = np.abs(pressure_peak_pa) / np.sqrt(2.0)
    floor = REFERENCE_PRESSURE_PA * 10.0 ** (SILENCE_DB / 20.0)
    return np.asarray(20.0 * np.log10(np.maximum(effective, floor) / REFERENCE_PRESSURE_PA))


def energy_sum(level_db: Real, axis: int | tuple[int, ...]) -> Real:
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


def _a_gain(frequency: Real) -> Real:
    square = frequency**2
    return np.asarray(_c_gain(frequency) * square / np.sqrt((square + _F2**2) * (square + _F3**2)))


def _c_gain(frequency: Real) -> Real:
    square = frequency**2
    return np.asarray(_F4**2 * square / ((square + _F1**2) * (square + _F4**2)))


def _in_db(gain: Callable[[Real], Real], frequency_hz: Real | float) -> Real:
    """Gain relative to 1 kHz in dB; SILENCE_DB where nothing passes (0 Hz)."""
    relative = gain(np.asarray(frequency_hz, dtype=float)) / gain(np.asarray(1000.0))
    return np.asarray(20.0 * np.log10(np.maximum(relative, 10.0 ** (SILENCE_DB / 20.0))))
