"""Values of criteria over the speeds, by draw."""

import xarray as xr


def largest_by_draw(results: xr.Dataset, name: str) -> xr.DataArray | None:
    """Largest of a variable over the speeds, (draw, option); none where it was not drawn."""
    return results[name].max("speed", skipna=False) if name in results else None
