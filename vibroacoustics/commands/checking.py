"""Limits as commands take them: read first, held against the orders, told on stdout."""

from pathlib import Path

import typer
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


def print_margins(results: xr.Dataset, file: Path) -> None:
    """Print the margins and where they are, if there are limits."""
    if "order_limit" in results:
        typer.echo(report.limits_text(results))
        typer.echo(f"limits: {file} (the exit code is 0, exceeded or not)")
