"""Levels and totals of predicted pressures with their bands, as variables of the vocabulary."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, power_of_level, sound_pressure_level
from ..base.vocabulary import WEIGHTINGS, stamp
from ..base.weighting import WEIGHTING
from .band import amplitude_band, power_band


def line_variables(
    pressure: ComplexArray, drawn: ComplexArray, coords: Mapping[str, Any]
) -> dict[str, xr.DataArray]:
    """Pressure and level of each line with its band.

    Parameters
    ----------
    pressure : peak, Pa, shape (option, receiver, frequency)
    drawn : of measurements drawn again, shape (draw, option, receiver, frequency)
    coords : of these three
    """
    low, high = amplitude_band(pressure, drawn)
    return {
        "predicted_pressure": stamp("predicted_pressure", pressure, coords),
        "predicted_level": stamp("predicted_level", sound_pressure_level(pressure), coords),
        "predicted_level_low": stamp("predicted_level_low", sound_pressure_level(low), coords),
        "predicted_level_high": stamp("predicted_level_high", sound_pressure_level(high), coords),
    }


def total_variables(
    pressure: ComplexArray, drawn: ComplexArray, coords: Mapping[str, Any]
) -> dict[str, xr.DataArray]:
    """Level of all lines and its change against the first option; see `line_variables`."""
    frequency = np.asarray(coords["frequency"])
    at = {"option": coords["option"], "receiver": coords["receiver"], "weighting": list(WEIGHTINGS)}
    power, powers = _powers(pressure, frequency), _powers(drawn, frequency)
    ratio, ratios = power / power[:1], powers / powers[:, :1]
    low, high = map(level_of_power, power_band(power, powers))
    change_low, change_high = map(level_of_power, power_band(ratio, ratios))
    change_low[0] = change_high[0] = 0.0  # of the reference against itself
    return {
        "predicted_total_level": stamp("predicted_total_level", level_of_power(power), at),
        "predicted_total_level_low": stamp("predicted_total_level_low", low, at),
        "predicted_total_level_high": stamp("predicted_total_level_high", high, at),
        "predicted_total_change": stamp("predicted_total_change", level_of_power(ratio), at),
        "predicted_total_change_low": stamp("predicted_total_change_low", change_low, at),
        "predicted_total_change_high": stamp("predicted_total_change_high", change_high, at),
    }


def _powers(pressure: ComplexArray, frequency_hz: Array) -> Array:
    """Mean square of all lines re (20 µPa)², by weighting, shape (..., receiver, weighting)."""
    square = np.abs(pressure) ** 2 / 2.0 / REFERENCE_PRESSURE_PA**2
    gains = np.array([power_of_level(WEIGHTING[name](frequency_hz)) for name in WEIGHTINGS])
    return np.asarray(square @ gains.T)
