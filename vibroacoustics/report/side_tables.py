"""Files of numbers beside the report: what its page leaves out, at full precision."""

import xarray as xr

from .kept_sections import sections_of
from .tables import DataTable, to_csv


def side_tables(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the tables that sections write beside the page, by the name of their file."""
    tables = [section.tables(results) for section in sections_of(results)]
    return {name: table for each in tables for name, table in each.items() if any(table.values())}


def side_files(results: xr.Dataset) -> dict[str, bytes]:
    """Return the tables of all sections as CSV."""
    return {
        name: to_csv(list(table), zip(*table.values(), strict=True))
        for name, table in side_tables(results).items()
    }
