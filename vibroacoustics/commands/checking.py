"""Limits as commands take them: read first, compared with the orders."""

from pathlib import Path

import xarray as xr

from ..results.limit import Limit
from ..results.limits_file import read_limits
from ..results.order_limits import with_limits


def read(path: Path | None) -> tuple[Limit, ...]:
    """Limits of a file; none without one."""
    return () if path is None else read_limits(path)


def held_against(results: xr.Dataset, limits: tuple[Limit, ...]) -> xr.Dataset:
    """Results with limits and margins, where there are limits."""
    return with_limits(results, limits) if limits else results
