"""Sound by third octave: noise of the sources, unmodelled noise, and all sound."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes
from .by_source import membership, weighting_power
from .labelled import level
from .measured_points import BASELINE_BANDS, MIDDLE_HZ, UNMODELLED_BANDS

_UNMODELLED_COLUMNS: Final = [BASELINE_BANDS.index(band) for band in UNMODELLED_BANDS]


def noise_levels(
    axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound], remaining: Array
) -> xr.Dataset:
    """Label the levels in third octaves of noise and, without a baseline, of all sound; unweighted.

    Parameters
    ----------
    axes : speeds, options and receivers
    received : sound of these cases, and of others
    remaining : A-weighted unmodelled noise in `UNMODELLED_BANDS`, shape (speed, option, receiver,
        band), Pa²
    """
    noise = np.array([[_noise(received[s, o], axes) for o in axes.options] for s in axes.speeds])
    unmodelled = unmodelled_in_bands(remaining)
    bands = {"noise_band": [band.nominal_hz for band in BASELINE_BANDS]}
    lines = [[_lines(received[s, o]) for o in axes.options] for s in axes.speeds]
    sources = np.array(lines) + noise
    values = {
        "noise_band_level": level(noise),
        "sources_band_level": level(sources),
        "unmodelled_band_level": level(unmodelled),
    }
    if not axes.measured_orders:
        values["total_band_level"] = level(sources + unmodelled)
    return stamped(values, axes.by_receiver | bands)


def unmodelled_in_bands(remaining: Array) -> Array:
    """Return unmodelled noise without weighting in `BASELINE_BANDS`, shape (..., band), Pa².

    Parameters
    ----------
    remaining : A-weighted, in `UNMODELLED_BANDS`, shape (..., band), Pa²
    """
    unmodelled = np.zeros((*remaining.shape[:-1], len(BASELINE_BANDS)))
    unmodelled[..., _UNMODELLED_COLUMNS] = remaining / weighting_power(
        "A", MIDDLE_HZ[_UNMODELLED_COLUMNS]
    )
    return unmodelled


def _lines(sound: ReceivedSound) -> Array:
    """Mean squares of the lines of all sources together, shape (receiver, band), Pa²."""
    square = 0.5 * np.abs(sound.pressure.sum(axis=0)) ** 2
    return np.asarray(square @ membership(sound.lines.frequency_hz, BASELINE_BANDS))


def _noise(sound: ReceivedSound, axes: LevelAxes) -> Array:
    """Mean squares of all sources' noise, shape (receiver, band), Pa²."""
    square = np.zeros((len(axes.receivers), len(BASELINE_BANDS)))
    for part in sound.noise:
        square += part.power @ membership(part.frequency_hz, BASELINE_BANDS)
    return square
