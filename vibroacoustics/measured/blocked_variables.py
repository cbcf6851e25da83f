"""Blocked forces and their validation as variables of the vocabulary."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_amplitude, level_of_power
from ..base.vocabulary import AXES, stamp
from ..levels.bands import Band, bands_between
from ..mechanics.added import third_octave_number
from .band import TRIED, amplitude_band, power_band

REFERENCE_ACCELERATION: Final = 1e-6
"""m/s², ISO 1683."""

Variables = dict[str, xr.DataArray]


def force_variables(
    force: ComplexArray, sampled: ComplexArray, coords: Mapping[str, Any], wrench: Array | None
) -> Variables:
    """Forces with their band, and their sum and moment where positions are known.

    Parameters
    ----------
    force : peak, N, shape (frequency, point)
    sampled : samples of the forces by measurements with errors, shape (sample, frequency, point)
    coords : `force_point` and `frequency`
    wrench : force and moment per force, shape (6, point)
    """
    low, high = amplitude_band(force, sampled)
    variables = {
        "blocked_force": stamp("blocked_force", force.T, coords),
        "blocked_force_low": stamp("blocked_force_low", low.T, coords),
        "blocked_force_high": stamp("blocked_force_high", high.T, coords),
    }
    if wrench is not None:
        total = wrench @ force.T
        coordinates = {"axis": list(AXES), "frequency": coords["frequency"]}
        variables["blocked_force_sum"] = stamp("blocked_force_sum", total[:3], coordinates)
        variables["blocked_moment_sum"] = stamp("blocked_moment_sum", total[3:], coordinates)
    return variables


def inversion_variables(
    condition: Array, truncation: float, errors: Array, frequency_hz: Array
) -> Variables:
    """Return the condition of the inversion, and the errors that its truncation was chosen by."""
    tried = {"tried_truncation": list(TRIED)}
    return {
        "condition_number": stamp("condition_number", condition, {"frequency": frequency_hz}),
        "inversion_truncation": stamp("inversion_truncation", truncation),
        "left_out_error": stamp("left_out_error", errors, tried),
    }


def validation_variables(
    predicted: ComplexArray,
    measured: ComplexArray,
    sampled: ComplexArray,
    sampled_measurement: ComplexArray,
    units: Sequence[str],
    coords: Mapping[str, Any],
) -> Variables:
    """Levels by the forces beside those measured, line by line and in third octaves.

    Parameters
    ----------
    predicted, measured : displacement, m, or pressure, Pa, shape (frequency, validation)
    sampled, sampled_measurement : samples by measurements with errors, shape (sample, frequency,
        validation)
    units : `m` or `Pa` of each; displacements become accelerations
    coords : `validation_point` and `frequency`
    """
    frequency = np.asarray(coords["frequency"])
    are_points = np.array([unit == "m" for unit in units])
    derived = (2.0 * np.pi * frequency[:, None]) ** 2 / REFERENCE_ACCELERATION
    # effective values over the reference
    scale = np.where(are_points, derived, 1.0 / REFERENCE_PRESSURE_PA) / np.sqrt(2.0)
    predicted, measured = predicted * scale, measured * scale
    sampled, sampled_measurement = sampled * scale, sampled_measurement * scale
    low, high = amplitude_band(predicted, sampled)
    lines = {
        "validation_measured": np.abs(measured),
        "validation_predicted": np.abs(predicted),
        "validation_predicted_low": low,
        "validation_predicted_high": high,
        "validation_difference": np.abs(predicted) / np.maximum(np.abs(measured), 1e-300),
    }
    coordinates = {
        **coords,
        "validation_quantity": (
            "validation_point",
            ["acceleration" if unit == "m" else "sound pressure" for unit in units],
        ),
    }
    variables = {
        name: stamp(name, level_of_amplitude(values).T, coordinates)
        for name, values in lines.items()
    }
    bands = bands_between(3, frequency[0], frequency[-1])
    by_band = {key: value for key, value in coordinates.items() if key != "frequency"}
    return variables | _band_variables(
        _powers(predicted, frequency, bands),
        _powers(measured, frequency, bands),
        _powers(sampled, frequency, bands) / _powers(sampled_measurement, frequency, bands),
        {**by_band, "band": [band.nominal_hz for band in bands]},
    )


def _band_variables(
    predicted: Array, measured: Array, ratios: Array, coordinates: Mapping[str, Any]
) -> Variables:
    """Levels of powers re the reference, shape (validation, band); empty bands are no numbers.

    `ratios` are those of sampled measurements, shape (sample, validation, band).
    """
    ratio = predicted / measured
    low, high = power_band(ratio, ratios)
    powers = {
        "validation_band_measured": measured,
        "validation_band_predicted": predicted,
        "validation_band_difference": ratio,
        "validation_band_difference_low": low,
        "validation_band_difference_high": high,
    }
    return {
        name: stamp(name, level_of_power(values), coordinates) for name, values in powers.items()
    }


def _powers(values: ComplexArray, frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """Power of all lines of each band, shape (..., validation, band); no number where it has
    none."""
    numbers = third_octave_number(np.array([band.middle_hz for band in bands]))
    lines = third_octave_number(frequency_hz)[:, None] == numbers
    powers = np.swapaxes(np.abs(values) ** 2, -1, -2) @ lines.astype(float)
    return np.asarray(np.where(lines.any(axis=0), powers, np.nan))
