"""Levels of recorded signals: equivalent, Fast and Slow maxima, and in bands.

Every function takes the reference value: 20 µPa belongs to sound pressure alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.errors import ParameterError
from ..base.weighting import WEIGHTING, check_weighting
from ..study.order_analysis import BAND_METHODS, BandMethod
from .band_meter import BandMeter
from .bands import Band, band_sums, check_measurable
from .filter_bank import filtered_energy
from .level_meter import LevelMeter, MeterPlan


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

    With A and C the first and last 0.1 s are omitted, at most a quarter of the recording at either
    end: the weighting runs in there, and what is cut off at the ends would click.

    Parameters
    ----------
    signal : shape (..., time), in the reference's unit
    sample_rate_hz : sample rate of the signal
    reference : see level_reference
    weighting : A, C or Z

    Raises
    ------
    ParameterError
        A sample is not finite, or the weighting is unknown.
    """
    check_weighting(weighting)
    squares = np.array([meter.mean_square(weighting) for meter in _meters(signal, sample_rate_hz)])
    levels = mean_square_level(squares.reshape(*signal.shape[:-1], 3), reference)
    return RecordedLevels(levels[..., 0], levels[..., 1], levels[..., 2])


def band_levels(
    signal: Array,
    sample_rate_hz: float,
    bands: Sequence[Band],
    reference: float,
    weighting: str,
    method: BandMethod = "sums",
) -> Array:
    """Equivalent levels in bands of a recording, dB.

    Parameters
    ----------
    signal : shape (..., time), in the reference's unit
    sample_rate_hz : sample rate of the signal
    bands : below half the sample rate
    reference : see level_reference
    weighting : A, C or Z
    method : "sums" of the lines within a band; or "filters" of IEC 61260-1 of class 1, whose skirts
        let in what lies beside the band

    Returns
    -------
    shape (..., band)

    Raises
    ------
    ParameterError
        A sample is not finite, a band reaches half the sample rate, weighting or method is unknown.
    """
    check_weighting(weighting)
    check_measurable(bands, sample_rate_hz)
    if weighting == "Z" and method == "sums":
        return mean_square_level(_unweighted(signal, sample_rate_hz, bands), reference)
    meters = _meters(signal, sample_rate_hz)
    shape = (*signal.shape[:-1], len(bands))
    return mean_square_level(in_bands(meters, bands, weighting, method).reshape(shape), reference)


def in_bands(
    meters: Sequence[LevelMeter], bands: Sequence[Band], weighting: str, method: BandMethod
) -> Array:
    """Mean squares in bands from the lines of meters, shape (meter, band), unit squared.

    Parameters
    ----------
    meters : meters of one plan, to which all samples have been added
    bands : below half the sample rate
    weighting, method : see band_levels

    Raises
    ------
    ParameterError
        The method is unknown.
    """
    if method not in BAND_METHODS:
        raise ParameterError(f"method = {method!r}: must be one of {', '.join(BAND_METHODS)}")
    plan = meters[0].plan
    gain = power_of_level(WEIGHTING[weighting](plan.frequency_hz))
    energy = gain * np.array([meter.lines / meter.weight for meter in meters])
    if method == "filters":
        return filtered_energy(energy, plan.frequency_hz, plan.sample_rate_hz, bands)
    return band_sums(energy, plan.sample_rate_hz, plan.length, bands)


def _unweighted(signal: Array, sample_rate_hz: float, bands: Sequence[Band]) -> Array:
    """Mean square in bands, shape (..., band)."""
    sums = []
    for samples in signal.reshape(-1, signal.shape[-1]):
        meter = BandMeter(samples.size, sample_rate_hz, bands)
        meter.add(samples)
        sums.append(meter.mean_square())
    return np.array(sums).reshape(*signal.shape[:-1], len(bands))


def _meters(signal: Array, sample_rate_hz: float) -> list[LevelMeter]:
    """A meter of each channel, with all of its samples."""
    plan = MeterPlan(signal.shape[-1], sample_rate_hz)
    meters = []
    for samples in signal.reshape(-1, signal.shape[-1]):
        meters.append(LevelMeter(plan, 0.0))
        meters[-1].add(samples)
    return meters
