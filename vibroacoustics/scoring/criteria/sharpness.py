"""Sharpness of the sound."""

import xarray as xr

from ...base.registry import register
from ...sound.of_results import with_hearing
from ...study.criterion import Criterion


@register
class Sharpness(Criterion):
    """Sharpness (DIN 45692), mean of the microphones.

    Worst over the speeds, with nominal values.
    """

    name = "sharpness_acum"
    label = "Sharpness (DIN 45692), mean of the microphones"
    unit = "acum"
    position = 7.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, acum."""
        judged = with_hearing(results)
        sharpness = judged["sharpness"].fillna(0.0).where(judged["loudness"].notnull())
        return sharpness.mean("receiver", skipna=False).max("speed", skipna=False)
