"""Time axes and sample rates among named arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .array_columns import Column, column_of
from .axes import Axis
from .named_arrays import (
    RATE_NAMES,
    TIME_NAMES,
    UNIT_NAMES,
    NamedArray,
    as_text,
    attribute_text,
    is_rate,
    is_start,
    is_time,
    names_of_times,
    nearest,
    owner_of,
)
from .quantities import axis_factor, find_time_factor
from .recorded import MINIMUM_SAMPLES, MissingError, Request, Samples, listed

_PROBES: Final = 9
"""Places at which the first column of a table is looked at."""
_RATE_UNITS: Final = {"": 1.0, "Hz": 1.0, "1/s": 1.0, "s-1": 1.0, "kHz": 1e3, "MHz": 1e6}
_SINCE: Final = " since "
_DATE: Final = "wf_start_time"
"""Attribute with the date at which a channel starts, as npTDMS writes it to HDF5."""


def coordinates(arrays: Sequence[NamedArray]) -> set[str]:
    """Names of arrays that are the axis of others: coordinates, and times by their names."""
    by_name = {array.name: array for array in arrays}
    axes = {
        axis
        for array in arrays
        for axis in array.dimensions
        if axis in by_name and len(by_name[axis].shape) == 1 and by_name[axis].is_number
    }
    return axes | {a.name for a in arrays if owner_of(a.name) in by_name and _grows(a)}


def _grows(array: NamedArray) -> bool:
    """Whether a vector of numbers grows at the points at which it is looked at, as a time does."""
    if not array.is_number or array.size < MINIMUM_SAMPLES or array.size != max(array.shape):
        return False
    probes = sorted({0, 1, *np.linspace(0, array.size - 1, _PROBES).astype(int).tolist()})
    values = [float(_stored_times(array, probe, probe + 1)[0]) for probe in probes]
    return bool(np.all(np.diff(values) > 0.0))


def time_of(arrays: Sequence[NamedArray], column: Column) -> NamedArray | None:
    """Time axis of a channel: of its dimension, of its name, or the nearest; None without one.

    Raises
    ------
    ParameterError
        The coordinate of its dimension is no time.
    """
    array = column.array
    axes = array.dimensions[column.time_axis : column.time_axis + 1]
    for axis in (each for each in arrays if each.name in axes):
        unit = attribute_text(axis, UNIT_NAMES)
        if is_time(axis.name) or (unit and find_time_factor(unit) is not None):
            return axis
        if unit:
            raise ParameterError(
                f"channel {column.name!r}: its axis {axis.name!r} has the unit {unit!r}: a "
                "recording needs a time"
            )
    names = names_of_times(array.name)
    named = [each for each in arrays if each.name in names and _grows(each)]
    return (
        named[0] if named else nearest([each for each in arrays if is_time(each.name)], array.name)
    )


def leading_time(columns: Sequence[Column]) -> NamedArray | None:
    """First column of a table where it grows evenly, as only a time does; None without one.

    Whole steps are those of a counter.
    """
    table = columns[0].array
    if len(table.shape) != 2 or min(table.shape) < 2:
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
    arrays: Sequence[NamedArray], column: Column, attributes: Mapping[str, Any]
) -> float | None:
    """Sample rate of a channel: of its attributes, or of the file and the nearest number.

    Raises
    ------
    ParameterError
        There are several that differ.
    """
    numbers = [a for a in arrays if a.is_number and np.prod(a.shape) == 1 and is_rate(a.name)]
    number = nearest(numbers, column.array.name)
    stated = [value for name, value in column.array.attributes.items() if is_rate(name)]
    if not stated:
        stated = [value for name, value in attributes.items() if is_rate(name)]
        stated += [] if number is None else [_rate_of(number)]
    rates = {float(np.asarray(value, dtype=float).item()) for value in stated}
    increment = column.array.attributes.get("wf_increment")
    if increment is not None and not rates:
        rates = {1.0 / float(np.asarray(increment).item())}
    if len(rates) > 1:
        raise ParameterError(f"states several sample rates: {sorted(rates)} Hz; choose channels")
    return rates.pop() if rates else None


def _rate_of(number: NamedArray) -> float:
    """Sample rate in Hz of a number, whose unit may be kHz or MHz.

    Raises
    ------
    ParameterError
        It has another unit.
    """
    unit = attribute_text(number, UNIT_NAMES)
    if unit not in _RATE_UNITS:
        raise ParameterError(
            f"{number.name!r} has the unit {unit!r}: a sample rate needs Hz, kHz or MHz"
        )
    return float(np.asarray(number.values(), dtype=float).item()) * _RATE_UNITS[unit]


def axes_of(
    arrays: Sequence[NamedArray],
    columns: Sequence[Column],
    times: Sequence[NamedArray | None],
    rates_hz: Sequence[float | None],
    request: Request,
) -> tuple[list[Axis], str]:
    """Time axis of each channel, and the date of their origin, ISO 8601, empty where unknown.

    Parameters
    ----------
    arrays : arrays of the file
    columns : channels
    times : time of each channel; None without one
    rates_hz : sample rate that is stated of each channel; None without one
    request : its sample rate overrides those
    """
    made: dict[Any, tuple[Axis, np.datetime64 | None]] = {}
    axes = []
    for column, time, rate_hz in zip(columns, times, rates_hz, strict=True):
        key = (None if time is None else time.name, rate_hz, *_start(column))
        if key not in made:
            made[key] = _axis(column, time, request.sample_rate_hz or rate_hz)
        _check_length(column, made[key][0], time)
        axes.append(made[key])
    origin = _origin(arrays)
    if origin is None:
        return [axis for axis, _ in axes], ""
    shifted = {id(axis): _since(axis, date, origin) for axis, date in made.values()}
    return [shifted[id(axis)] for axis, _ in axes], str(origin)


def _origin(arrays: Sequence[NamedArray]) -> np.datetime64 | None:
    """Earliest date from which an array of the file counts or starts; None without one."""
    texts = [attribute_text(array, UNIT_NAMES).partition(_SINCE)[2] for array in arrays]
    texts += [as_text(array.attributes.get(_DATE, "")) for array in arrays]
    return min((date for text in texts if (date := _date(text)) is not None), default=None)


def _since(axis: Axis, date: np.datetime64 | None, origin: np.datetime64) -> Axis:
    """The axis with its start counted from the origin; axes without a date start there."""
    later = 0 if date is None else int((date - origin).astype(np.int64))
    return axis if later == 0 else replace(axis, start_s=axis.start_s + 1e-9 * later)


def _axis(
    column: Column, time: NamedArray | None, rate_hz: float | None
) -> tuple[Axis, np.datetime64 | None]:
    start_s, date_text = _start(column)
    if time is None:
        if rate_hz is None:
            raise MissingError(
                "states no sample rate: give sample_rate_hz, or save a vector "
                f"{TIME_NAMES[1]} or a number {RATE_NAMES[2]}"
            )
        return Axis(column.samples, rate_hz, start_s), _date(date_text)
    unit, _, since = (attribute_text(time, UNIT_NAMES) or "s").partition(_SINCE)
    factor = axis_factor(f"time {time.name!r}" if time.name != "time" else "time", unit)
    first = 0 if not time.is_whole else int(_stored_times(time, 0, 1)[0])
    times = partial(_times, time, factor, first)
    axis = Axis(int(np.prod(time.shape)), rate_hz, start_s + factor * first, times)
    return axis, _date(since or date_text)


def _start(column: Column) -> tuple[float, str]:
    """Start of a channel that its attributes state: s, and a date."""
    stated = [value for name, value in column.array.attributes.items() if is_start(name)]
    starts = [np.asarray(value).ravel() for value in stated]
    start_s = next((float(s[0]) for s in starts if s.size == 1 and s.dtype.kind in "iuf"), 0.0)
    return start_s, as_text(column.array.attributes.get(_DATE, ""))


def _date(text: str) -> np.datetime64 | None:
    """Date of a text in UTC, to nanoseconds; None where it is none."""
    plain = text.strip().removesuffix("Z").removesuffix("UTC").removesuffix("+00:00").strip()
    try:
        return np.datetime64(plain.replace(" ", "T", 1), "ns") if plain else None
    except ValueError:
        return None


def _check_length(column: Column, axis: Axis, time: NamedArray | None) -> None:
    """Refuse a channel and a time that differ in length."""
    if time is not None and axis.samples != column.samples:
        listing = [f"{column.name} {column.samples}", f"{time.name} {axis.samples}"]
        raise ParameterError(
            f"variables differ in length ({listed(listing)}): choose channels of the same length"
        )


def _stored_times(time: NamedArray, first: int, last: int) -> Samples:
    along = int(np.argmax(time.shape)) if time.shape else 0
    part = tuple(
        slice(first, last) if axis == along else slice(0, side)
        for axis, side in enumerate(time.shape)
    )
    return np.asarray(time.values(part)).ravel()


def _times(time: NamedArray, factor: float, origin: int, first: int, last: int) -> Samples:
    """Times in s from one sample to another; whole numbers from the first of all."""
    stored = _stored_times(time, first, last)
    numbers = stored.astype(np.int64) - origin if time.is_whole else stored
    return numbers.astype(float) * factor
