"""Many speeds: worked through in blocks, so that no more is held in memory than is kept."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.vocabulary import COORDINATES

SPEEDS_IN_BLOCK: Final = 50
TIME_SERIES: Final = (
    "force", "moment", "shaft_speed", "shaft_acceleration", "crank_time", "crank_angle",
)  # fmt: skip
"""Left out of the results of many speeds."""


def blocks(speeds: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """The first speed alone, of which the size of the result follows, then many at a time."""
    yield tuple(speeds[:1])
    for first in range(1, len(speeds), SPEEDS_IN_BLOCK):
        yield tuple(speeds[first : first + SPEEDS_IN_BLOCK])


def gathered(parts: Iterable[xr.Dataset], speeds: int) -> xr.Dataset:
    """The blocks' variables one after the other along the speed.

    Each block is copied to its rows before the next one is made. Figures that a block does not
    have are NaN.
    """
    rows: dict[str, xr.Variable] = {}
    figures: list[xr.DataArray] = []
    steady, done = xr.Dataset(), 0
    for part in parts:
        figures.append(part["reported_figure"])
        block = {"speed": slice(done, done + part.sizes["speed"])}
        for name, variable in part.drop_dims("figure").variables.items():
            if "speed" in variable.dims:
                if name not in rows:
                    rows[str(name)] = _empty(variable, speeds)
                rows[str(name)][block] = variable
        steady, done = part.drop_dims(["speed", "figure"]), block["speed"].stop
    coords = {name: rows.pop(name) for name in list(rows) if name in COORDINATES}
    of_all = steady.assign_coords(coords).assign(rows)
    return of_all.assign(reported_figure=_all_figures(figures))


def _empty(variable: xr.Variable, speeds: int) -> xr.Variable:
    """A variable of as many speeds, to be filled."""
    shape = [speeds if dim == "speed" else size for dim, size in variable.sizes.items()]
    return xr.Variable(variable.dims, np.empty(shape, dtype=variable.dtype), variable.attrs)


def _all_figures(parts: Sequence[xr.DataArray]) -> xr.DataArray:
    names = list(dict.fromkeys(name for part in parts for name in part["figure"].values))
    figures: xr.DataArray = xr.concat([part.reindex(figure=names) for part in parts], "speed")
    return figures
