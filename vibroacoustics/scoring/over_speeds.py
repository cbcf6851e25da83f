"""Values of criteria over the speeds, by sample."""

import xarray as xr


def largest_by_sample(results: xr.Dataset, name: str) -> xr.DataArray | None:
    """Largest of a variable over the speeds, (sample, option); none where it was not sampled."""
    return results[name].max("speed", skipna=False) if name in results else None
