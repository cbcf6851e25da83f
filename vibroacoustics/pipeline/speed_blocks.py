"""Many speeds: worked through in blocks, so that no more is held in memory than is kept."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import prod
from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import COORDINATES, VARIABLES, WEIGHTINGS
from ..study.study import Study

SPEEDS_IN_BLOCK: Final = 50
MOST_BYTES: Final = 2**31
TIME_SERIES: Final = ("force", "moment", "shaft_speed", "crank_time", "crank_angle")
OF_SOUND: Final = ("pressure_line", "order_level", "level_modelled", "level_total")
"""What is computed of the motion later, and by far the largest of it."""


def blocks(speeds: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """The first speed alone, of which the size of the result follows, then many at a time."""
    yield tuple(speeds[:1])
    for first in range(1, len(speeds), SPEEDS_IN_BLOCK):
        yield tuple(speeds[first : first + SPEEDS_IN_BLOCK])


def gathered(parts: Iterable[xr.Dataset], speeds: int) -> xr.Dataset:
    """The blocks' variables one after the other along the speed.

    Each block is copied to its rows before the next one is made. Figures that a block does not
    have are NaN.

    Parameters
    ----------
    parts : one dataset a block
    speeds : number of speeds of all blocks
    """
    rows: dict[str, xr.Variable] = {}
    figures: list[xr.DataArray] = []
    steady, done = xr.Dataset(), 0
    for part in parts:
        figures.append(part["reported_figure"])
        at = {"speed": slice(done, done + part.sizes["speed"])}
        for name, variable in part.drop_dims("figure").variables.items():
            if "speed" in variable.dims:
                if name not in rows:
                    rows[str(name)] = _room(variable, speeds)
                rows[str(name)][at] = variable
        steady, done = part.drop_dims(["speed", "figure"]), at["speed"].stop
    coords = {name: rows.pop(name) for name in list(rows) if name in COORDINATES}
    whole = steady.assign_coords(coords).assign(rows)
    return whole.assign(reported_figure=_all_figures(figures))


def _room(variable: xr.Variable, speeds: int) -> xr.Variable:
    """A variable of as many speeds, to be filled."""
    shape = [speeds if dim == "speed" else size for dim, size in variable.sizes.items()]
    return xr.Variable(variable.dims, np.empty(shape, dtype=variable.dtype), variable.attrs)


def _all_figures(parts: Sequence[xr.DataArray]) -> xr.DataArray:
    names = list(dict.fromkeys(name for part in parts for name in part["figure"].values))
    figures: xr.DataArray = xr.concat([part.reindex(figure=names) for part in parts], "speed")
    return figures


def check_size(study: Study, first: xr.Dataset, progress: Progress) -> None:
    """Tell the size of the result, known from the first speed, and refuse too large a one.

    Raises
    ------
    ParameterError
        The result would take more than 2 GiB.
    """
    size = result_bytes(study, first)
    progress(f"result of {size / 1e6:.0f} MB", 1, 1)
    if size > MOST_BYTES:
        raise ParameterError(
            f"operation.speed_rpm: the result of {len(study.operation.speed_rpm)} speeds takes "
            f"{size / 2**30:.1f} GiB; allowed 2 GiB: take fewer speeds, options, orders or time "
            "series"
        )


def result_bytes(study: Study, first: xr.Dataset) -> int:
    """Bytes in memory of all that the result holds by speed."""
    sizes = {
        **{str(name): size for name, size in first.sizes.items()},
        "speed": len(study.operation.speed_rpm),
        "receiver": len(study.receivers),
        "weighting": len(WEIGHTINGS),
        "sound_source": 1 + len(study.sources),
        "line": first.sizes["order"],
    }
    by_speed = [str(name) for name, array in first.data_vars.items() if "speed" in array.dims]
    return sum(_bytes(name, sizes) for name in (*by_speed, *OF_SOUND))


def _bytes(name: str, sizes: Mapping[str, int]) -> int:
    variable = VARIABLES[name]
    return prod(sizes[dim] for dim in variable.dims) * (16 if variable.complex_peak else 8)
