"""Sharpness of the sound."""

import xarray as xr

from ...base.registry import register
from ...sound import of_results
from ...study.criterion import Criterion


@register
class Sharpness(Criterion):
    """Sharpness (DIN 45692), mean of the microphones.

    Worst over the speeds; of the values as given. It needs mosqito, extra `sound`.
    """

    name = "sharpness_acum"
    label = "Sharpness (DIN 45692), mean of the microphones"
    unit = "acum"
    position = 7.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, acum."""
        worst: xr.DataArray = of_results.sharpness(results).mean("receiver").max("speed")
        return worst
