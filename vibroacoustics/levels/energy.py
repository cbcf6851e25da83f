"""A-weighted energy of lines and third octaves by source, and the loudest line."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from .by_source import weighting_power
from .measured_points import MIDDLE_HZ

UNMODELLED: Final = "unmodelled"
"""Part of the energy that no source makes."""


def energy_of_lines(pressure: ComplexArray, frequency_hz: Array) -> Array:
    """Compute what each source adds to the A-weighted mean squares of lines, Pa².

    The sum over the sources is the mean square of the line; a part is negative where a source
    works against the others.

    Parameters
    ----------
    pressure : complex peaks, shape (source, ..., line), Pa
    frequency_hz : frequency of the lines, not a number where there is none, shape (line,)
    """
    sounds = np.nan_to_num(frequency_hz) > 0.0
    weight = weighting_power("A", np.where(sounds, frequency_hz, 1.0)) * sounds
    return np.asarray(0.5 * (pressure * pressure.sum(axis=0).conj()).real * weight)


def loudest_line(pressure_line: xr.DataArray) -> str:
    """Name the line above 0 Hz with the highest A-weighted level.

    Parameters
    ----------
    pressure_line : at a microphone in one case, (sound_source, line), with `tone_frequency`
    """
    lines = pressure_line.transpose("sound_source", "line")
    hertz = np.nan_to_num(lines["tone_frequency"].values)
    energy = energy_of_lines(lines.values, hertz).sum(axis=0)
    return str(lines["line"].values[np.argmax(np.where(hertz > 0.0, energy, -np.inf))])


def unmodelled_energy(level: xr.DataArray) -> Array:
    """Compute A-weighted mean squares of unmodelled noise, shape (..., noise band), Pa².

    Parameters
    ----------
    level : level of the noise in third octaves, unweighted, (..., noise_band), dB
    """
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level.values)
    return np.asarray(square * weighting_power("A", MIDDLE_HZ))
