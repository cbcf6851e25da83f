"""Files of numbers beside the report: what its page leaves out, at full precision."""

import xarray as xr

from .kept_sections import sections_of
from .tables import DataTable


def side_tables(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the tables that sections write beside the page, by the name of their file."""
    tables = [section.tables(results) for section in sections_of(results)]
    return {name: table for each in tables for name, table in each.items() if any(table.values())}
