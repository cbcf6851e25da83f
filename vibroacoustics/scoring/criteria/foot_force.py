"""Force into the feet."""

import xarray as xr

from ...base.registry import register
from ...study.criterion import Criterion
from ..over_speeds import largest_by_sample


@register
class FootForce(Criterion):
    """Largest 1x force into a foot, worst over the speeds."""

    name = "foot_force_1x_n"
    label = "Largest foot force, 1×"
    unit = "N"
    position = 1.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Largest 1x force into a foot, N."""
        return results["foot_force_amplitude"].sel(order=1).max(("speed", "foot"))

    def by_sample(self, results: xr.Dataset) -> xr.DataArray:
        """Largest 1x force into a foot in each sample, N."""
        return largest_by_sample(results, "foot_force_1x")
