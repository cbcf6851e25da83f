"""One gain for all sounds of a study: pascal at full scale."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, power_of_level

_STEPS: Final = [2e-5, 5e-5, *(float(f"{n}e{k}") for k in range(-4, 6) for n in (1, 2, 5))]
"""From the threshold of hearing on, Pa."""
_CREST: Final = 5.5
"""Largest value of ten minutes of Gaussian noise over its effective value."""


def full_scale_of(results: xr.Dataset, calibration_db: float | None = None) -> float:
    """Pressure at full scale that no option exceeds at any microphone, listener and speed, Pa.

    A number 1, 2 or 5 times a power of ten, so that files of one study, made at different times,
    have the same gain.

    Parameters
    ----------
    results : of a run, with its noise by third octave
    calibration_db : level of a tone that has to fit, too
    """
    peak = abs(results["pressure_line"].sum("sound_source")).sum("line")
    square = _square(results["noise_band_level"]) + _square(results["unmodelled_band_level"])
    if "baseline_band_level" in results:
        square = square + _square(results["baseline_band_level"])
    if "baseline_order_level" in results:
        level = results["baseline_order_level"].fillna(-np.inf)
        of_orders = np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(level)
        peak = peak + of_orders.sum("baseline_order")
    highest = max(float((peak + _CREST * np.sqrt(square)).max()), _highest_in_room(results))
    if calibration_db is not None:
        highest = max(highest, peak_of_tone(calibration_db))
    return next_full_scale(highest)


def _highest_in_room(results: xr.Dataset) -> float:
    """What no option exceeds at any listener; 0 without a room."""
    if "room_pressure_line" not in results:
        return 0.0
    square: xr.DataArray = abs(results["room_pressure_line"]) ** 2
    if "room_plate_line_level" in results:
        level = results["room_plate_line_level"]
        square = square + 2.0 * REFERENCE_PRESSURE_PA**2 * power_of_level(level)
    noise = _square(results["room_noise_band_level"])
    return float(((square**0.5).sum("line") + _CREST * noise**0.5).max())


def peak_of_tone(level_db: float) -> float:
    """Peak of a tone of a level, Pa."""
    return float(np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(level_db))


def _square(level: xr.DataArray) -> xr.DataArray:
    """Mean square of all bands, Pa²."""
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level.fillna(-np.inf))
    return square.sum([dim for dim in level.dims if str(dim).endswith("band")])


def next_full_scale(value: float) -> float:
    """The next of 1, 2, 5, 10, 20, …, 2e-5 at least: in pascal the threshold of hearing."""
    return next((step for step in _STEPS if step >= value * (1.0 - 1e-9)), value)
