"""Time axis and sample rate among named arrays."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .array_columns import Column, column_of
from .named_arrays import RATE_NAMES, TIME_NAMES, NamedArray, as_text, is_rate, is_time, nearest
from .quantities import time_factor
from .recorded import MissingError, Request, Samples, check_rate, listed
from .time_axis import even_part

_PROBES: Final = 9
"""Places at which the first column of a table is looked at."""


def time_of(arrays: Sequence[NamedArray], columns: Sequence[Column]) -> NamedArray | None:
    """The time axis that stands nearest to the channels; None without one.

    Raises
    ------
    ParameterError
        The channels have several.
    """
    times = [array for array in arrays if is_time(array.name)]
    axes = {nearest(times, column.array.name) for column in columns}
    if len(axes) > 1:
        names = sorted("none" if axis is None else axis.name for axis in axes)
        raise ParameterError(f"channels have several time axes ({listed(names)}): choose channels")
    return axes.pop()


def leading_time(columns: Sequence[Column]) -> NamedArray | None:
    """First column of a table where it grows evenly, as only a time does; None without one.

    Whole steps are those of a counter.
    """
    table = columns[0].array
    if len(table.shape) != 2 or min(table.shape) < 2 or any(c.array is not table for c in columns):
        return None
    first = column_of(table, 0)
    last = table.shape[table.time_axis] - 1
    probes = sorted({0, 1, min(2, last), *np.linspace(0, last, _PROBES).astype(int).tolist()})
    try:
        times = np.array([float(first.values((slice(probe, probe + 1),))[0]) for probe in probes])
    except StorageError:  # not all of it is stored
        return None
    step = (times[-1] - times[0]) / last
    if not step > 0.0 or not np.isfinite(step) or float(step).is_integer():
        return None
    off = np.abs(times - times[0] - step * np.array(probes))
    return first if float(np.max(off)) <= 0.5 * step else None


def stated_rate_hz(
    arrays: Sequence[NamedArray], columns: Sequence[Column], attributes: Mapping[str, Any]
) -> float | None:
    """Sample rate from an attribute of the file or of the channels, or from the nearest number.

    Raises
    ------
    ParameterError
        There are several that differ.
    """
    stated = [value for name, value in attributes.items() if is_rate(name)]
    numbers = [a for a in arrays if a.is_number and np.prod(a.shape) == 1 and is_rate(a.name)]
    for column in columns:
        stated_here = column.array.attributes.items()
        stated += [value for name, value in stated_here if is_rate(name)]
        number = nearest(numbers, column.array.name)
        stated += [] if number is None else [number.values()]
    rates = {float(np.asarray(value, dtype=float).item()) for value in stated}
    if len(rates) > 1:
        raise ParameterError(f"states several sample rates: {sorted(rates)} Hz; choose channels")
    return rates.pop() if rates else None


def part_of(
    time: NamedArray | None, stated: float | None, samples: int, request: Request
) -> tuple[int, int, float]:
    """First sample that is wanted, the one behind the last, and the sample rate.

    Raises
    ------
    ParameterError
        No rate is stated, or several that differ, or the times are not even.
    """
    if time is None:
        rate = request.sample_rate_hz or stated
        if rate is None:
            raise MissingError(
                "states no sample rate: give sample_rate_hz, or save a vector "
                f"{TIME_NAMES[1]} or a number {RATE_NAMES[2]}"
            )
        check_rate(rate)
        return (*request.part(samples, rate), rate)
    first, last, rate = even_part(partial(_times, time), samples, request)
    if stated is None or request.sample_rate_hz is not None:
        return first, last, rate
    if not abs(stated / rate - 1.0) * (last - first) <= 1.0:  # they differ by more than a sample
        raise ParameterError(
            f"states a sample rate of {stated:.9g} Hz, but its time axis has {rate:.9g} Hz: "
            "give sample_rate_hz"
        )
    return first, last, stated


def _times(time: NamedArray, first: int, last: int) -> Samples:
    """Times in s from one sample to another."""
    along = int(np.argmax(time.shape)) if time.shape else 0
    part = tuple(
        slice(first, last) if axis == along else slice(0, side)
        for axis, side in enumerate(time.shape)
    )
    factor = time_factor(as_text(time.attributes.get("units", "s")))
    return np.asarray(time.values(part), dtype=float).ravel() * factor
