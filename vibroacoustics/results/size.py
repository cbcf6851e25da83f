"""Size of a result, before it is computed."""

from collections.abc import Mapping
from math import prod
from typing import Final

import xarray as xr

from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import VARIABLES, WEIGHTINGS
from ..study.study import Study

MOST_BYTES: Final = 2**31
OF_SOUND: Final = (
    "pressure_line", "order_level", "level_modelled", "level_total", "room_pressure_line",
)  # fmt: skip
"""Variables that are computed of the motion later, by far the largest."""


def check_size(study: Study, first: xr.Dataset, progress: Progress) -> None:
    """State the size of the result, known from the first speed, and refuse too large a one.


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
    """Bytes in memory of all that the result holds by speed, of what the first speed holds."""
    sizes = {
        **{str(name): size for name, size in first.sizes.items()},
        "speed": len(study.operation.speed_rpm),
        "receiver": len(study.receivers),
        "weighting": len(WEIGHTINGS),
        "sound_source": 1 + len(study.sources),
        "line": first.sizes["order"],
        "listener": 0 if study.room is None else len(study.room.listeners),
    }
    by_speed = [str(name) for name, array in first.data_vars.items() if "speed" in array.dims]
    return sum(_bytes(name, sizes) for name in (*by_speed, *OF_SOUND))


def _bytes(name: str, sizes: Mapping[str, int]) -> int:
    variable = VARIABLES[name]
    return prod(sizes[dim] for dim in variable.dims) * (16 if variable.complex_peak else 8)
