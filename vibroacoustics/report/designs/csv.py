"""All designs of a search as CSV."""

import json
from collections.abc import Iterator

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ..tables import to_csv


def designs_csv(found: xr.Dataset) -> bytes:
    """A line a design: its values by dotted key, objectives and constraints, whether it is allowed.

    Parameters
    ----------
    found : dataset of a search
    """
    keys = [str(key) for key in found["design_variable"].values]
    wanted = [
        f"{name} ({unit})" if unit else str(name)
        for name, unit in zip(found["wanted"].values, found["wanted_unit"].values, strict=True)
    ]
    head = ("design", "generation", *keys, *wanted, "meets_constraints", "on_front")
    return to_csv(head, _rows(found, keys))


def _rows(found: xr.Dataset, keys: list[str]) -> Iterator[tuple[str | float, ...]]:
    choices = json.loads(found.attrs["choices"])
    columns: list[list[str | float]] = []
    for key, column in zip(keys, found["design_value"].values.T, strict=True):
        words = choices.get(key)
        columns.append([words[round(v)] for v in column] if words else _cells(column))
    columns += [_cells(column) for column in found["wanted_value"].values.T]
    counted = [found[name].values.tolist() for name in ("meets_constraints", "on_front")]
    generation = found["search_generation"].values.tolist()
    yield from zip(np.arange(len(generation)).tolist(), generation, *columns, *counted, strict=True)


def _cells(column: Array) -> list[str | float]:
    """Values, empty where there is none."""
    return ["" if np.isnan(value) else value for value in column.tolist()]
