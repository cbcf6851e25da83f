"""Mass that an option adds."""

import xarray as xr

from ...base.registry import register
from ...study.criterion import Criterion


@register
class AddedMass(Criterion):
    """Mass added to the machine, worst over the speeds."""

    name = "added_mass_kg"
    label = "Added mass"
    unit = "kg"
    position = 5.0

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Added mass, kg."""
        return results["reported_figure"].sel(figure="added_mass_kg", drop=True).max("speed")
