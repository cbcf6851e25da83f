"""Audibility of tones of the sound."""

import xarray as xr

from ...base.registry import register
from ...study.criterion import Criterion


@register
class Audibility(Criterion):
    """Level of the most audible tone over its masked threshold.

    Worst over the microphones and speeds; audible from 0 dB, between -10 and 60 dB.
    """

    name = "audibility_db"
    label = "Most audible tone over its masked threshold"
    unit = "dB"
    position = 8.5

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, dB."""
        worst: xr.DataArray = results["decisive_audibility"].max("receiver").max("speed")
        return worst
