"""Moment that is left on the housing."""

import xarray as xr

from ...base.registry import register
from ...study.criterion import Criterion
from ..over_speeds import largest_by_sample


@register
class ResidualMoment(Criterion):
    """1x moment about the centre of mass, worst over the speeds."""

    name = "residual_moment_nm"
    label = "Residual moment, 1×"
    unit = "N m"
    position = 2.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """1x moment about the centre of mass, N m."""
        return results["moment_amplitude"].sel(order=1).max("speed")

    def by_sample(self, results: xr.Dataset) -> xr.DataArray:
        """1x moment about the centre of mass in each sample, N m."""
        return largest_by_sample(results, "moment_1x")
