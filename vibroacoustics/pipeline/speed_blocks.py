"""Many speeds: worked through in blocks, so that no more is held in memory than is kept."""

from collections.abc import Iterator, Mapping, Sequence
from math import prod
from typing import Final

import numpy as np
import xarray as xr

from ..errors import ParameterError
from ..parameters.study import Study
from ..schema import COORDINATES, VARIABLES, WEIGHTINGS
from .progress import Progress

SPEEDS_IN_BLOCK: Final = 50
MOST_BYTES: Final = 2**31
TIME_SERIES: Final = ("force", "moment", "shaft_speed", "crank_time", "crank_angle")
OF_SOUND: Final = ("pressure_order", "order_level", "level_modelled", "level_total")
"""What is computed of the motion later, and by far the largest of it."""


def blocks(speeds: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """The first speed alone, of which the size of the result follows, then many at a time."""
    yield tuple(speeds[:1])
    for first in range(1, len(speeds), SPEEDS_IN_BLOCK):
        yield tuple(speeds[first : first + SPEEDS_IN_BLOCK])


def joined(parts: list[xr.Dataset]) -> xr.Dataset:
    """The blocks' variables one after the other along the speed; the list of blocks is emptied.

    Variable by variable, so that only one of them is held twice. Figures that a block does not
    have are NaN.
    """
    if len(parts) == 1:
        return parts.pop()
    facts = list(dict.fromkeys(name for part in parts for name in part["fact"].values))
    parts[:] = [part.reindex(fact=facts) for part in parts]
    steady = parts[0].drop_dims("speed")
    names = [str(name) for name in parts[0].variables if name not in steady.variables]
    variables = {}
    for name in names:
        variables[name] = _end_to_end([part.variables[name] for part in parts])
        parts[:] = [part.drop_vars(name) for part in parts]
    parts.clear()
    return steady.assign(variables).set_coords(COORDINATES.keys() & variables.keys())


def _end_to_end(pieces: Sequence[xr.Variable]) -> xr.Variable:
    dims = pieces[0].dims
    values = np.concatenate([piece.values for piece in pieces], axis=dims.index("speed"))
    return xr.Variable(dims, values, pieces[0].attrs)


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
    }
    by_speed = [str(name) for name, array in first.data_vars.items() if "speed" in array.dims]
    return sum(_bytes(name, sizes) for name in (*by_speed, *OF_SOUND))


def _bytes(name: str, sizes: Mapping[str, int]) -> int:
    variable = VARIABLES[name]
    return prod(sizes[dim] for dim in variable.dims) * (16 if variable.complex_peak else 8)
