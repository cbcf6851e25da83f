"""A-weighted energy of lines and third octaves by source, and the loudest line."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_shift, power_of_level
from ..base.vocabulary import stamped
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes
from .by_source import sound_by_source, weighting_power
from .measured_points import BASELINE_BANDS, MIDDLE_HZ

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


def energy_variables(
    axes: LevelAxes,
    sound: Sequence[ReceivedSound],
    pressure_line: xr.DataArray,
    level: xr.DataArray,
    medians: xr.Dataset | None = None,
) -> xr.Dataset:
    """Label the energies whose sums over sources are those of all sound.

    Parameters
    ----------
    axes : axes of sources and receivers, with the shown options
    sound : sound of each option at the receivers
    pressure_line : (option, sound_source, receiver, line), with `tone_frequency`
    level : level of unmodelled noise, (option, receiver, noise_band)
    medians : `total_band_level` of all samples, which the sums of the third octaves get, and
        `representative_total_band_level`, of the same speed and options; none with nominal values
    """
    parts = [sound_by_source(case, axes.bands).mutual.sum(axis=1) for case in sound]
    noise = unmodelled_energy(level.transpose("option", "receiver", "noise_band"))[:, None]
    lines = pressure_line.transpose("sound_source", "option", "receiver", "line")
    of_lines = energy_of_lines(lines.values, lines["tone_frequency"].values)
    bands = np.concatenate([np.array(parts), noise], axis=1)
    if medians is not None:
        bands *= _to_medians(medians)[:, None]
    values = {
        "line_energy": np.moveaxis(of_lines, 0, 1),
        "band_energy": bands,
    }
    coords = {
        "shown_option": list(axes.options),
        "sound_source": list(axes.sources),
        "energy_part": [*axes.sources, UNMODELLED],
        "receiver": list(axes.receivers),
        "line": lines["line"].values,
        "noise_band": [band.nominal_hz for band in BASELINE_BANDS],
    }
    return stamped(values, coords)


def _to_medians(results: xr.Dataset) -> Array:
    """Factors from the third octaves of the representative sample to the medians of all samples.

    Returns
    -------
    shape (option, receiver, noise band)
    """
    median_db, sample_db = (
        results[name].transpose("option", "receiver", "noise_band").values
        for name in ("total_band_level", "representative_total_band_level")
    )
    return np.asarray(power_of_level(level_shift(median_db, sample_db)))
