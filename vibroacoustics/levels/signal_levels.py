"""Levels of recorded signals: equivalent, Fast and Slow maxima, and in bands.

Every function takes the reference value: 20 µPa belongs to sound pressure alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.errors import ParameterError
from .bands import Band, band_mean_square
from .time_weighting import (
    FAST_TIME_CONSTANT_S,
    SLOW_TIME_CONSTANT_S,
    time_weighted_mean_square,
)
from .weighting import weighted_signal


@dataclass(frozen=True)
class RecordedLevels:
    """Levels of a recording in dB, shape (...) of its channels.

    Attributes
    ----------
    equivalent_db : Leq over all of it
    fast_maximum_db : greatest Fast-weighted level
    slow_maximum_db : greatest Slow-weighted level
    """

    equivalent_db: Array
    fast_maximum_db: Array
    slow_maximum_db: Array


def level_reference(unit: str, reference: float | None = None) -> float:
    """Reference value of a channel's levels: 20 µPa for Pa, for any other unit the one given.

    Raises
    ------
    ParameterError
        The unit is not Pa and no reference is given, or it is not above zero.
    """
    value = REFERENCE_PRESSURE_PA if reference is None and unit == "Pa" else reference
    if value is None:
        raise ParameterError(f"unit {unit!r}: its levels need a reference value; only Pa has one")
    if not 0.0 < value < np.inf:
        raise ParameterError(f"reference = {value:g} {unit}: must be above 0")
    return value


def equivalent_level(signal: Array, reference: float) -> Array:
    """Leq = 10 lg(mean x² / x_0²) over the last axis, dB."""
    return mean_square_level(np.mean(np.square(signal, dtype=float), axis=-1), reference)


def recorded_levels(
    signal: Array, sample_rate_hz: float, reference: float, weighting: str
) -> RecordedLevels:
    """Equivalent level and greatest Fast and Slow levels of a recording.

    Parameters
    ----------
    signal : shape (..., time), in the reference's unit
    sample_rate_hz : of the signal
    reference : see level_reference
    weighting : A, C or Z
    """
    weighted = weighted_signal(signal, sample_rate_hz, weighting)
    fast, slow = (
        np.max(time_weighted_mean_square(weighted, sample_rate_hz, constant), axis=-1)
        for constant in (FAST_TIME_CONSTANT_S, SLOW_TIME_CONSTANT_S)
    )
    return RecordedLevels(
        equivalent_db=equivalent_level(weighted, reference),
        fast_maximum_db=mean_square_level(fast, reference),
        slow_maximum_db=mean_square_level(slow, reference),
    )


def band_levels(
    signal: Array, sample_rate_hz: float, bands: Sequence[Band], reference: float, weighting: str
) -> Array:
    """Levels in bands from the Fourier transform of all of the recording, dB.

    Parameters
    ----------
    signal : shape (..., time), in the reference's unit
    sample_rate_hz : of the signal
    bands : below half the sample rate
    reference : see level_reference
    weighting : A, C or Z

    Returns
    -------
    shape (..., band)
    """
    weighted = weighted_signal(signal, sample_rate_hz, weighting)
    return mean_square_level(band_mean_square(weighted, sample_rate_hz, bands), reference)
