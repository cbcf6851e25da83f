"""Operating points of a recording's orders: those that are shown one by one, and their branches."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from .tables import Columns, Table, table_of

_MOST_SPEEDS: Final = 6
"""Operating points in the text; all are in the CSV."""


def shown_speeds(results: xr.Dataset) -> set[float]:
    """Some speeds, from the lowest to the highest of every branch, rpm."""
    speeds = results["speed"].values
    indices = np.linspace(0, speeds.size - 1, _MOST_SPEEDS).round().astype(int)
    return set(speeds[indices].tolist())


def shown_points(results: xr.Dataset) -> Iterator[tuple[xr.Dataset, str]]:
    """Results at each operating point that is shown, and words such as `2900 rpm, run-up`."""
    shown, is_branched = shown_speeds(results), has_branches(results)
    for number, speed in enumerate(results["speed"].values.tolist()):
        if speed in shown:
            point = results.isel(speed=number)
            branch = f", {point['branch'].item()}" if is_branched else ""
            yield point, f"{speed:.0f} rpm{branch}"


def omitted_points(results: xr.Dataset) -> str:
    """Say how many operating points of a table are shown; nothing where all are."""
    every = results["speed"].values
    count = int(np.isin(every, [*shown_speeds(results)]).sum())
    return "" if count == every.size else f"; {count} of {every.size} speeds, all in the CSV"


def branch_column(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Branch of each operating point as a column, where it is known."""
    return {"branch": results["branch"]} if "branch" in results.coords else {}


def branched_table(
    caption: str,
    rows: Sequence[Mapping[str, Any]],
    columns: Columns,
    words: frozenset[int],
    results: xr.Dataset,
) -> Table:
    """Return a table of operating points, without its column `branch` where there is one alone.

    Parameters
    ----------
    caption, rows, columns : see `table_of`
    words : numbers of the columns that hold words, that of the branch not among them
    results : results of the rows
    """
    number = [name for _, name, _ in columns].index("branch")
    if has_branches(results):
        return table_of(caption, rows, columns, words | {number})
    others = [column for column in columns if column[1] != "branch"]
    return table_of(caption, rows, others, frozenset(word - (word > number) for word in words))


def has_branches(results: xr.Dataset) -> bool:
    """Whether operating points are of several branches, such as run-up and coast-down."""
    return "branch" in results.coords and np.unique(results["branch"].values).size > 1
