"""Levels of the channels of a recording, labelled."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.vocabulary import WEIGHTINGS, stamp
from .bands import bands_between, measurable_bands
from .signal_levels import band_levels, recorded_levels

LOWEST_BAND_HZ: Final = 25.0
HIGHEST_BAND_HZ: Final = 20e3
_DETECTORS: Final = ("equivalent", "fast_maximum", "slow_maximum")


def channel_levels(signal: xr.DataArray, rate_hz: float) -> xr.Dataset:
    """Levels of the channels of sound pressure; not a number for others, which have no reference.

    A recording without sound pressure has none. An offset is no sound and is taken off.
    """
    pressure = signal["channel_unit"].values == "Pa"
    if not pressure.any():
        return xr.Dataset()
    bands = measurable_bands(bands_between(3, LOWEST_BAND_HZ, HIGHEST_BAND_HZ), rate_hz)
    shape = (signal.sizes["channel"], len(WEIGHTINGS))
    broadband = {name: np.full(shape, np.nan) for name in _DETECTORS}
    in_bands = np.full((*shape, len(bands)), np.nan)
    values = signal.values[pressure]
    sound = (values - values.mean(axis=-1, keepdims=True), rate_hz)
    for number, weighting in enumerate(WEIGHTINGS):
        recorded = recorded_levels(*sound, REFERENCE_PRESSURE_PA, weighting)
        for name, array in broadband.items():
            array[pressure, number] = getattr(recorded, f"{name}_db")
        in_bands[pressure, number] = band_levels(*sound, bands, REFERENCE_PRESSURE_PA, weighting)
    coords = {"channel": signal["channel"], "weighting": list(WEIGHTINGS)}
    by_band = {**coords, "band": [band.nominal_hz for band in bands]}
    labelled = {
        f"{name}_level": stamp(f"{name}_level", array, coords) for name, array in broadband.items()
    }
    return xr.Dataset({**labelled, "band_level": stamp("band_level", in_bands, by_band)})
