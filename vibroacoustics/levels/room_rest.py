"""Unmodelled noise of the machine as a power by third octave for a room."""

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from .by_source import membership, weighting_power
from .measured_points import BASELINE_BANDS, MIDDLE_HZ

_A: Array = weighting_power("A", MIDDLE_HZ)


def rest_in_bands(results: xr.Dataset, receiver: str) -> Array:
    """Mean squares beside the model at a microphone, shape (speed, option, band), Pa².

    In `BASELINE_BANDS`. Their spectrum is that of unmodelled noise and, where third octaves were
    measured, what these are over the model; their A-weighted sum is what the level of the machine
    is over that of the model.

    Parameters
    ----------
    results : variables of the levels
    receiver : at which the machine's noise is published
    """
    unmodelled = results["unmodelled_band_level"].sel(receiver=receiver)
    unmodelled_pa2 = _square(unmodelled.transpose("speed", "option", "noise_band"))
    if "baseline_band_level" in results:
        levels = results["baseline_band_level"].sel(receiver=receiver)
        measured = _square(levels.transpose("speed", "option", "baseline_band"))
        excess = np.maximum(measured - _modelled(results, receiver), 0.0)
        unmodelled_pa2 = np.where(np.isfinite(measured), excess, unmodelled_pa2)
    wanted = beside_model(results, receiver)
    loud = unmodelled_pa2 @ _A
    factor = np.where(loud > 0.0, wanted / np.where(loud > 0.0, loud, 1.0), 0.0)
    return np.asarray(unmodelled_pa2 * factor[..., None])


def beside_model(results: xr.Dataset, receiver: str) -> Array:
    """A-weighted mean squares of the machine less those of the model, (speed, option), Pa²."""
    total, modelled = results["level_total"], results["level_modelled"].sel(weighting="A")
    squares = [
        _square(each.sel(receiver=receiver).transpose("speed", "option"))
        for each in (total, modelled)
    ]
    return np.maximum(squares[0] - squares[1], 0.0)


def _modelled(results: xr.Dataset, receiver: str) -> Array:
    """Mean squares of the model at a microphone in bands, shape (speed, option, band), Pa²."""
    pressure = results["pressure_line"].sel(receiver=receiver).sum("sound_source")
    square = 0.5 * np.abs(pressure.transpose("speed", "option", "line").values) ** 2
    frequency = results["tone_frequency"].transpose("speed", "line").values
    levels = results["noise_band_level"].sel(receiver=receiver)
    bands = _square(levels.transpose("speed", "option", "noise_band"))
    for number, row in enumerate(np.nan_to_num(frequency)):
        bands[number] += square[number] @ membership(row, BASELINE_BANDS)
    return bands


def _square(level: xr.DataArray) -> Array:
    return np.asarray(REFERENCE_PRESSURE_PA**2 * power_of_level(level.values))
