"""Rating level at the windows of a study."""

import xarray as xr

from ...base.errors import ParameterError
from ...base.registry import register
from ...study.criterion import Criterion


@register
class RatingLevel(Criterion):
    """Rating level, with its adjustments for tones; worst over windows and speeds.

    It needs the table `[rating]` of a study.
    """

    name = "rating_level_dba"
    label = "Rating level, worst over the windows"
    unit = "dB(A)"
    position = 8.7

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, dB(A)."""
        if "rating_level" not in results:
            raise ParameterError("rating_level_dba: needs windows in the study, [rating.windows]")
        worst: xr.DataArray = results["rating_level"].max(["rating_window", "speed"])
        return worst
