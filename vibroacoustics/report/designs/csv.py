"""All designs of a search as columns."""

import json
from collections.abc import Iterator

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ..tables import DataTable, columns_of


def designs_data(search: xr.Dataset) -> DataTable:
    """A line a design: its values by dotted key, objectives and constraints, whether it is allowed.

    Parameters
    ----------
    search : dataset of a search
    """
    keys = [str(key) for key in search["design_variable"].values]
    wanted = [
        f"{name} ({unit})" if unit else str(name)
        for name, unit in zip(search["wanted"].values, search["wanted_unit"].values, strict=True)
    ]
    head = ("design", "generation", *keys, *wanted, "meets_constraints", "on_front")
    return columns_of(head, _rows(search, keys))


def _rows(search: xr.Dataset, keys: list[str]) -> Iterator[tuple[str | float, ...]]:
    choices = json.loads(search.attrs["choices"])
    columns: list[list[str | float]] = []
    for key, column in zip(keys, search["design_value"].values.T, strict=True):
        words = choices.get(key)
        columns.append([words[round(v)] for v in column] if words else _cells(column))
    columns += [_cells(column) for column in search["wanted_value"].values.T]
    counted = [search[name].values.tolist() for name in ("meets_constraints", "on_front")]
    generation = search["search_generation"].values.tolist()
    yield from zip(np.arange(len(generation)).tolist(), generation, *columns, *counted, strict=True)


def _cells(column: Array) -> list[str | float]:
    """Values, empty where there is none."""
    return ["" if np.isnan(value) else value for value in column.tolist()]
