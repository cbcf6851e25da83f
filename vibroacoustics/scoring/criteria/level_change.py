"""Change of the modelled level."""

import xarray as xr

from ...base.decibel import level_of_power, power_of_level
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.estimates import in_samples
from ...study.criterion import Criterion


@register
class LevelChange(Criterion):
    """Change of the modelled A-weighted level, energy mean over the microphones.

    Worst over the speeds. The mean keeps a microphone near a node of the sound field from deciding
    the score.
    """

    name = "level_change_db"
    label = "Change of the modelled level, energy mean of the microphones"
    unit = "dB"
    position = 3.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Change against `none`, dB."""
        return _worst_change(results["level_modelled"].sel(weighting="A"))

    def by_sample(self, results: xr.Dataset) -> xr.DataArray:
        """Change against `none` in each sample, dB."""
        return _worst_change(in_samples(results, "level_modelled").values)


def _worst_change(level: xr.DataArray) -> xr.DataArray:
    mean_level = level_of_power(power_of_level(level).mean("receiver", skipna=False))
    change: xr.DataArray = mean_level - mean_level.sel(option=REFERENCE_OPTION, drop=True)
    return change.max("speed", skipna=False)
