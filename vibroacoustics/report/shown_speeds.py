"""Speeds that the report shows: all, or a few of many."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.remembered import remembered
from ..results.stored_study import nearest_speed, speeds
from .blocks import Text

MOST_SPEEDS: Final = 6
"""Speeds that get a table, a panel or a curve of their own."""
FEWEST_OVER_SPEED: Final = 3
"""Speeds from which on curves over the speed are drawn."""


def many_speeds(results: xr.Dataset) -> bool:
    """Whether there are more speeds than are shown one by one."""
    return len(speeds(results)) > MOST_SPEEDS


def over_speed(results: xr.Dataset) -> bool:
    """Whether there are lines at speeds enough to be drawn over."""
    return "pressure_line" in results and len(speeds(results)) >= FEWEST_OVER_SPEED


@remembered
def few_speeds(results: xr.Dataset) -> xr.Dataset:
    """The results at the speeds that are shown one by one: all, or six evenly chosen.

    These are the lowest, the highest, the nearest to the published one, and others between.
    """
    if not many_speeds(results):
        return results
    order = np.argsort(speeds(results))
    chosen = np.linspace(0, order.size - 1, MOST_SPEEDS).round().astype(int)
    published = np.flatnonzero(results["speed"].values[order] == nearest_speed(results))
    if published[0] not in chosen:
        between = np.abs(chosen - published[0])
        between[[0, -1]] = order.size  # lowest and highest stay
        chosen[np.argmin(between)] = published[0]
    return results.isel(speed=np.sort(order[chosen]))


def few_speeds_words(results: xr.Dataset, file: str = "comparison.csv") -> str:
    """`6 of 200 speeds; all are in comparison.csv.`; empty where all speeds are shown."""
    if not many_speeds(results):
        return ""
    return f"{MOST_SPEEDS} of {len(speeds(results))} speeds; all are in {file}."


def chosen_speeds(results: xr.Dataset, file: str) -> list[Text]:
    """A note that says how many speeds are shown, and which file holds all; none where all are."""
    words = few_speeds_words(results, file)
    return [Text(words, "note")] if words else []
