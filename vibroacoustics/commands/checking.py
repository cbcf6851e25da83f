"""Limits as commands take them: read first, compared with the orders, shown with their margins."""

from pathlib import Path

import xarray as xr

from .. import report
from ..results.limit import Limit
from ..results.limits_file import read_limits
from ..results.order_limits import with_limits


def read(path: Path | None) -> tuple[Limit, ...]:
    """Limits of a file; none without one."""
    return () if path is None else read_limits(path)


def held_against(results: xr.Dataset, limits: tuple[Limit, ...]) -> xr.Dataset:
    """Results with limits and margins, where there are limits."""
    return with_limits(results, limits) if limits else results


def with_margins(text: str, results: xr.Dataset) -> str:
    """Text with the margins below it, if there are limits."""
    return f"{text}\n{report.limits_text(results)}" if "order_limit" in results else text


def margin_files(results: xr.Dataset, file: Path) -> dict[str, Path]:
    """File of the margins by its label, if there are limits."""
    return {"limits": file} if "order_limit" in results else {}
