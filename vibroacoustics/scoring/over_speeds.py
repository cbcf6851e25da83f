"""Values of criteria over the speeds, by sample."""

import xarray as xr

from ..results.estimates import in_samples


def largest_by_sample(results: xr.Dataset, name: str) -> xr.DataArray:
    """Largest of a variable over the speeds, (sample, option)."""
    return in_samples(results, name).values.max("speed", skipna=False)
