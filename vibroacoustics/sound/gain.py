"""One gain for all sounds of a study: pascal at full scale."""

from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base.allowed import check_range
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level
from ..base.remembered import remembered
from .ingredients import Ingredients, ingredients, positions

_STEPS: Final = [2e-5, 5e-5, *(float(f"{n}e{k}") for k in range(-4, 6) for n in (1, 2, 5))]
"""Steps from the threshold of hearing on, Pa."""
_CREST: Final = 5.5
"""Largest value of ten minutes of Gaussian noise over its effective value."""


def full_scale_of(results: xr.Dataset, calibration_db: float | None = None) -> float:
    """Pressure at full scale that no option exceeds at any microphone, listener and speed, Pa.

    A number 1, 2 or 5 times a power of ten, so that files of one study, made at different times,
    have the same gain.

    Parameters
    ----------
    results : results of a run, with its noise by third octave
    calibration_db : level of a tone that has to fit, too
    """
    highest = _highest(results)
    if calibration_db is not None:
        highest = max(highest, peak_of_tone(calibration_db))
    return next_full_scale(highest)


@remembered
def _highest(results: xr.Dataset) -> float:
    """Pressure that no option exceeds anywhere, Pa."""
    names = [results[dim].values.tolist() for dim in ("option", "speed")]
    microphones = results["receiver"].values.tolist()
    receivers = positions(results) if "room_pressure_line" in results else microphones
    cases = product(names[0], receivers, names[1])
    return max(_peak(ingredients(results, *case)) for case in cases)


def _peak(sound: Ingredients) -> float:
    noise = np.sqrt(np.sum(sound.bands.pressure_pa**2))
    return float(np.abs(sound.lines.pressure_pa).sum() + _CREST * noise)


def peak_of_tone(level_db: float) -> float:
    """Peak of a tone of calibration, Pa."""
    check_range("calibration", level_db, 0.0, 140.0, "dB")
    return float(np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(level_db))


def next_full_scale(value: float) -> float:
    """The next of 1, 2, 5, 10, 20, …, 2e-5 at least: in pascal the threshold of hearing."""
    return next((step for step in _STEPS if step >= value * (1.0 - 1e-9)), value)
