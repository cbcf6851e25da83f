"""Levels in decibels: of powers and amplitudes and back, of sums, means and differences.

The only place with logarithms and powers of ten of levels. Arrays, numbers and labelled arrays are
taken alike and come back as what they were.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final, TypeVar, cast

import numpy as np

from .arrays import Array, ComplexArray
from .constants import REFERENCE_PRESSURE_PA
from .errors import ParameterError

if TYPE_CHECKING:
    import xarray as xr

Values = TypeVar("Values", float, Array, "xr.DataArray")

SILENCE_DB: Final = -300.0
"""Level that stands for no sound at all: finite, so that tables and sums stay numbers."""
NO_TONE_DB: Final = -60.0
"""Excess of a line that is no audible tone, or has no noise in its critical band."""


def level_of_power(ratio: Values) -> Values:
    """10 lg of a ratio of powers or mean squares, dB; SILENCE_DB at least."""
    least = power_of_level(SILENCE_DB)
    return cast(Values, 10.0 * np.log10(np.maximum(cast(Any, ratio), least)))


def level_of_amplitude(ratio: Values) -> Values:
    """20 lg of a ratio of amplitudes, at least zero, dB; SILENCE_DB at least."""
    least = amplitude_of_level(SILENCE_DB)
    return cast(Values, 20.0 * np.log10(np.maximum(cast(Any, ratio), least)))


def level_shift(wanted_db: Values, current_db: Values) -> Values:
    """Change that brings a level to another, dB; none where either is silence."""
    wanted, current = cast(Any, wanted_db), cast(Any, current_db)
    return cast(Values, (wanted - current) * ((wanted > SILENCE_DB) & (current > SILENCE_DB)))


def power_of_level(level_db: Values) -> Values:
    """Ratio of powers or mean squares that a level stands for: 10^(L/10)."""
    return cast(Values, np.power(10.0, cast(Any, level_db) / 10.0))


def amplitude_of_level(level_db: Values) -> Values:
    """Ratio of amplitudes that a level stands for: 10^(L/20)."""
    return cast(Values, np.power(10.0, cast(Any, level_db) / 20.0))


def sound_pressure_level(pressure_peak_pa: ComplexArray | Array | float) -> Array:
    """Level of a tone from its (complex) peak pressure: 20 lg(|P| / √2 / 20 µPa), dB."""
    effective = np.abs(pressure_peak_pa) / np.sqrt(2.0)
    return np.asarray(level_of_amplitude(effective / REFERENCE_PRESSURE_PA))


def mean_square_level(mean_square: Array | float, reference: float) -> Array:
    """Level of a signal's mean square: 10 lg(x² / x_0²), dB; SILENCE_DB at least.

    Raises
    ------
    ParameterError
        The mean square is not finite.
    """
    if not np.all(np.isfinite(mean_square)):
        raise ParameterError("signal: holds values that are not finite numbers")
    return np.asarray(level_of_power(np.asarray(mean_square) / reference**2))


def energy_sum(level_db: Array, axis: int | tuple[int, ...]) -> Array:
    """Level of the sum of incoherent sounds: 10 lg Σ 10^(L/10), dB."""
    return np.asarray(level_of_power(np.sum(power_of_level(np.asarray(level_db)), axis=axis)))


def energy_mean(level_db: Array | Sequence[float], axis: int = 0) -> Array:
    """Level of the mean of powers: 10 lg(1/N Σ 10^(L/10)), dB."""
    return np.asarray(level_of_power(np.mean(power_of_level(np.asarray(level_db)), axis=axis)))


def energy_difference(total_db: float, part_db: float) -> float:
    """Level that is left when a part is taken out of a total: 10 lg(10^(T/10) - 10^(P/10)), dB.

    Raises
    ------
    ValueError
        The part is at least as loud as the total.
    """
    if part_db >= total_db:
        raise ValueError(f"part of {part_db:.2f} dB is not below the total of {total_db:.2f} dB")
    return float(total_db + level_of_power(1.0 - power_of_level(part_db - total_db)))
