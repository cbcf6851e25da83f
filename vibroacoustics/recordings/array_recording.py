"""The recording that named arrays hold."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError
from .array_columns import (
    Column,
    check_claims,
    check_present,
    columns_of,
    own_columns,
    samples_of_parts,
    stored_limits,
)
from .array_times import axes_of, coordinates, leading_time, stated_rate_hz, time_of
from .axes import Axis, line_of
from .counts import count_words
from .named_arrays import NamedArray, as_text, is_time
from .packing import PACKING_NAMES, unpacked
from .recorded import Recorded, Request, Samples, check_size, listed

OWN_NAMES: Final = frozenset({"signal", "channel", "channel_unit"})
"""Variables of a recording that we wrote as netCDF (vocabulary.py)."""


def recorded(
    arrays: Sequence[NamedArray], attributes: Mapping[str, Any], request: Request
) -> Recorded:
    """The recording that the arrays of a file hold.

    Raises
    ------
    ParameterError
        There is no channel, no sample rate, or the channels differ in length.
    StorageError
        The arrays claim more samples than the cap allows.
    """
    by_name = {array.name: array for array in arrays}
    axes = coordinates(arrays)
    is_own = by_name.keys() >= OWN_NAMES
    columns = own_columns(by_name) if is_own else columns_of(arrays, axes)
    columns, leading, remarks = _without_times(arrays, columns, attributes)
    if not columns:
        raise ParameterError(
            f"holds no vector of numbers beside the time; its variables: {listed(list(by_name))}"
        )
    names, units = [column.name for column in columns], [column.unit for column in columns]
    columns = [columns[index] for index in request.chosen(names, units)]
    if not columns:
        raise ParameterError("no channel is chosen")
    remarks = [*remarks, *request.omissions(names, units), *_unread(arrays, columns, request)]
    times = [leading.get(c.array.name) or time_of(arrays, c) for c in columns]
    rates_hz = [stated_rate_hz(arrays, column, attributes) for column in columns]
    axis_of, date = axes_of(arrays, columns, times, rates_hz, request)
    _check_lengths(columns, axis_of)
    line = line_of([column.name for column in columns], axis_of, request)
    check_claims(columns, line.planned(request).parts)
    check_size(len(columns), line.last - line.first)
    stored = samples_of_parts(columns, line.parts)
    for column, values, (first, _) in zip(columns, stored, line.parts, strict=True):
        check_present(column, values, first, line.rate_hz)
    samples = [unpacked(v, c.array.attributes) for c, v in zip(columns, stored, strict=True)]
    start = as_text(attributes.get("start_time", "")) or date
    return line.recorded(
        [column.name for column in columns],
        [column.unit for column in columns],
        samples,
        start,
        remarks,
        limits=stored_limits(columns, stored, line),
        counts=[_counts(column, values) for column, values in zip(columns, stored, strict=True)],
    )


def _counts(column: Column, stored: Samples) -> str:
    """Words on counts without a factor; values that are packed, or marked as in CF, are none."""
    attributes = column.array.attributes
    return "" if {*PACKING_NAMES} & {*attributes} else count_words(column.unit, stored, attributes)


def _check_lengths(columns: Sequence[Column], axes: Sequence[Axis]) -> None:
    """Refuse channels of one sample rate, without times of their own, that differ in length."""
    lengths = {c.name: c.samples for c, axis in zip(columns, axes, strict=True) if not axis.times}
    rates = {axis.rate_hz for axis in axes}
    if len(set(lengths.values())) > 1 and len(rates) == 1:
        listing = [f"{name} {samples}" for name, samples in lengths.items()]
        raise ParameterError(
            f"variables differ in length ({listed(listing)}): choose channels of the same length"
        )


def _unread(arrays: Sequence[NamedArray], columns: Sequence[Column], request: Request) -> list[str]:
    """Remarks on arrays of numbers that have more dimensions than channels have."""
    if request.channels is not None:
        return []
    return [
        f"variable {array.name!r} of shape {array.shape} is not read: channels have one dimension, "
        "tables two"
        for array in arrays
        if array.is_number and len(array.shape) > 2 and np.prod(array.shape) > 1
    ]


def _without_times(
    arrays: Sequence[NamedArray], columns: Sequence[Column], attributes: Mapping[str, Any]
) -> tuple[list[Column], dict[str, NamedArray], list[str]]:
    """Channels, times that are the first columns of tables, by table, and remarks on these."""
    if any(is_time(array.name) for array in arrays):
        return list(columns), {}, []
    tables = dict.fromkeys(c.array.name for c in columns if len(c.array.shape) == 2)
    times, remarks = dict[str, NamedArray](), list[str]()
    for name in tables:
        of_table = [column for column in columns if column.array.name == name]
        time = leading_time(of_table)
        if time is None or of_table[0].array.dimensions:
            continue
        times[name] = time
        columns = [column for column in columns if column is not of_table[0]]
        if stated_rate_hz(arrays, of_table[0], attributes) is None:
            remarks.append(f"{time.name} grows evenly and is taken as the time in s")
    return list(columns), times, remarks
