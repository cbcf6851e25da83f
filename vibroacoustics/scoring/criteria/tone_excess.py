"""Prominence of tones of the sound."""

import xarray as xr

from ...base.registry import register
from ...study.criterion import Criterion


@register
class ToneExcess(Criterion):
    """Largest excess of a tone over its criterion.

    Worst over the microphones and speeds; prominent from 0 dB, between -60 and 60 dB.
    """

    name = "tone_excess_db"
    label = "Most prominent tone over its criterion"
    unit = "dB"
    position = 8.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, dB."""
        worst: xr.DataArray = results["largest_tone_excess"].max("receiver").max("speed")
        return worst
