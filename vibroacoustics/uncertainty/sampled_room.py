"""Level in a room of the weighted samples, labelled."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import HIGH, LOW, NOMINAL, SUFFIXES, stamped
from ..levels.labelled import level
from ..levels.room_levels import AirInRoom, beside_model
from ..results.estimates import QUANTILES, has_samples, in_samples

_SHARES: Final = {SUFFIXES[LOW]: QUANTILES[0], "": 0.5, SUFFIXES[HIGH]: QUANTILES[1]}
"""Probabilities of a smaller level, by what the name of its variable ends in."""


def sampled_room_level(air: AirInRoom, results: xr.Dataset, receiver: str) -> xr.Dataset:
    """Label the airborne level: median, ends of the interval, nominal value; empty without samples.

    A sample changes modelled sound and unmodelled noise at each listener as at the microphone of
    the published level.

    Parameters
    ----------
    air : at the listeners, nominal
    results : nominal levels at the microphones and those by sample
    receiver : microphone of the published level
    """
    if not has_samples(results):
        return xr.Dataset()
    nominal = _square(results["level_modelled"].sel(receiver=receiver, weighting="A"))
    total, modelled = (in_samples(results, name) for name in ("level_total", "level_modelled"))
    of_total, sampled = (
        _square(level_of.values.sel(receiver=receiver)) for level_of in (total, modelled)
    )
    noise, noises = beside_model(results, receiver), np.maximum(of_total - sampled, 0.0)
    silent = noise <= 0.0
    of_model = sampled / np.where(nominal > 0.0, nominal, 1.0)
    of_rest = np.where(silent, 0.0, noises / np.where(silent, 1.0, noise))
    square = air.modelled * of_model[..., None] + air.unmodelled * of_rest[..., None]
    ends = weighted_quantiles(level(square), total.weight, list(_SHARES.values()))
    values = {f"room_level{end}": level_db for end, level_db in zip(_SHARES, ends, strict=True)}
    values[f"room_level{SUFFIXES[NOMINAL]}"] = level(air.total)
    return stamped(values, air.coords)


def _square(levels: xr.DataArray) -> Array:
    """Mean squares, shape ([sample,] speed, option), Pa²."""
    power = power_of_level(levels.transpose(..., "speed", "option").values)
    return np.asarray(REFERENCE_PRESSURE_PA**2 * power)
