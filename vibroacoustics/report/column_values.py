"""Values of one column of the comparison."""

import xarray as xr

from ..base.remembered import remembered
from .columns import COLUMNS


@remembered
def column(results: xr.Dataset, name: str) -> xr.DataArray:
    """One column over option, speed and, for levels, receiver; the unit is in its name."""
    return COLUMNS[name].values(results).reset_coords(drop=True)
