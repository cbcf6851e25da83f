"""Loudness of the sound."""

import xarray as xr

from ...base.registry import register
from ...sound.of_results import with_hearing
from ...study.criterion import Criterion


@register
class Loudness(Criterion):
    """Loudness (ISO 532-1), mean of the microphones.

    Worst over the speeds, with nominal values.
    """

    name = "loudness_sone"
    label = "Loudness (ISO 532-1), mean of the microphones"
    unit = "sone"
    position = 6.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, sone."""
        loudness = with_hearing(results)["loudness"]
        return loudness.mean("receiver", skipna=False).max("speed", skipna=False)
