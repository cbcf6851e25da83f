"""Dependence of the benefit on the speed."""

from typing import Final

import xarray as xr

from ...base.decibel import level_of_amplitude
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.estimates import in_samples
from ...study.criterion import Criterion

SMALLEST_RATIO: Final = 1e-6
"""Smallest ratio: below -120 dB is rounding."""


@register
class SpeedSensitivity(Criterion):
    """Spread over the speeds of the change of the 1x foot force against `none`."""

    name = "speed_sensitivity_db"
    label = "Spread of the foot-force change over the speeds"
    unit = "dB"
    position = 4.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Largest minus smallest change, dB."""
        return _spread(results["foot_force_amplitude"].sel(order=1).max("foot"))

    def by_sample(self, results: xr.Dataset) -> xr.DataArray:
        """Largest minus smallest change in each sample, dB; none if the force was not sampled."""
        return _spread(in_samples(results, "foot_force_1x").values)


def _spread(foot: xr.DataArray) -> xr.DataArray:
    ratio = foot / foot.sel(option=REFERENCE_OPTION, drop=True)
    change = level_of_amplitude(ratio.clip(min=SMALLEST_RATIO))
    spread: xr.DataArray = change.max("speed", skipna=False) - change.min("speed", skipna=False)
    return spread
