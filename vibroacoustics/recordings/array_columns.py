"""Channels among named arrays: vectors, and rows or columns of tables."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .named_arrays import UNIT_NAMES, NamedArray, Part, as_text, attribute_text, is_time
from .packing import PACKING_NAMES, is_packed, missing, unsigned
from .recorded import Samples, by_channel, check_size, numbered
from .time_line import TimeLine

MAXIMUM_COLUMNS: Final = 10_000


@dataclass(frozen=True)
class Column:
    """One channel: a row or column of an array."""

    name: str
    unit: str
    array: NamedArray
    index: int
    time_axis: int

    @property
    def samples(self) -> int:
        """Samples of the whole recording."""
        return self.array.shape[self.time_axis]


def own_columns(by_name: Mapping[str, NamedArray]) -> list[Column]:
    """Channels of a recording that we wrote as netCDF.

    Raises
    ------
    ParameterError
        Its variables do not belong together.
    """
    signal = by_name["signal"]
    names, units = _texts(by_name["channel"]), _texts(by_name["channel_unit"])
    if not len(names) == len(units) == signal.shape[0] or len(signal.shape) != 2:
        raise ParameterError("signal, channel and channel_unit do not belong together")
    return [
        Column(name, unit, signal, index, 1)
        for index, (name, unit) in enumerate(zip(names, units, strict=True))
    ]


def _texts(array: NamedArray) -> list[str]:
    """Texts that are stored as rows of characters or as whole strings."""
    check_size(1, int(np.prod(array.shape)))
    stored = np.asarray(array.load(tuple(slice(0, side) for side in array.shape)))
    if stored.dtype == np.dtype("S1") and stored.ndim == 2:
        return [row.tobytes().rstrip(b"\0 ").decode("utf-8", "replace") for row in stored]
    return [as_text(text) for text in stored.ravel()]


def columns_of(arrays: Sequence[NamedArray], axes: Collection[str]) -> list[Column]:
    """All channels: vectors by their name, tables by name and number.

    Parameters
    ----------
    arrays : arrays of the file
    axes : names of those that are axes of others

    Raises
    ------
    StorageError
        A table has more columns than any recorder has channels.
    """
    columns = []
    for array in arrays:
        if is_time(array.name) or array.name in axes or not array.may_be_channels:
            continue
        width = min(array.shape) if len(array.shape) == 2 else 1
        if width > MAXIMUM_COLUMNS:
            raise StorageError(f"variable {array.name!r} claims {array.shape} values: too wide")
        unit = attribute_text(array, UNIT_NAMES)
        names = numbered([array.name] * width)
        columns += [
            Column(name, unit, array, index, array.time_axis) for index, name in enumerate(names)
        ]
    return columns


def column_of(table: NamedArray, number: int) -> NamedArray:
    """One row or column of a table as a vector; the time runs along its longer side."""
    axis = table.time_axis

    def load(part: Part) -> Any:
        indices = [part[0]]
        indices.insert(1 - axis, slice(number, number + 1))
        return np.asarray(table.load(tuple(indices))).ravel()

    shape = (table.shape[axis],)
    packing = {name: table.attributes[name] for name in PACKING_NAMES if name in table.attributes}
    return NamedArray(f"column {number + 1} of {table.name}", shape, True, load, packing)


def stored_samples(columns: Sequence[Column], first: int, last: int) -> list[Samples]:
    """Stored samples of each column; of a table those columns alone that are wanted, at once."""
    tables: dict[str, tuple[int, Samples]] = {}
    for column_of_array in {column.array.name: column for column in columns}.values():
        wanted = [column.index for column in columns if column.array is column_of_array.array]
        tables[column_of_array.array.name] = (
            min(wanted),
            _rows(column_of_array, min(wanted), max(wanted) + 1, first, last),
        )
    return [
        tables[column.array.name][1][column.index - tables[column.array.name][0]]
        for column in columns
    ]


def samples_of_parts(columns: Sequence[Column], parts: Sequence[tuple[int, int]]) -> list[Samples]:
    """Stored samples of the parts of the channels; tables are read at once."""
    stored: dict[int, Samples] = {}
    for part in dict.fromkeys(parts):
        rows = [row for row, each in enumerate(parts) if each == part]
        values = stored_samples([columns[row] for row in rows], *part)
        stored.update(zip(rows, values, strict=True))
    return [stored[row] for row in range(len(columns))]


def _rows(column: Column, low: int, high: int, first: int, last: int) -> Samples:
    """Stored values of the columns from `low` up to `high` of a table, shape (channel, time)."""

    def load(start: int, end: int) -> Samples:
        part = [slice(start, end)]
        if len(column.array.shape) == 2:
            part.insert(1 - column.time_axis, slice(low, high))
        values = np.asarray(column.array.load(tuple(part)))
        return values.reshape([side.stop - side.start for side in part])

    if len(column.array.shape) == 2 and column.time_axis == 0:
        return unsigned(by_channel(load, first, last, high - low), column.array.attributes)
    return unsigned(np.atleast_2d(load(first, last)), column.array.attributes)


def check_claims(columns: Sequence[Column], parts: Sequence[tuple[int, int]]) -> None:
    """Refuse samples that the bytes of the file cannot hold; see `NamedArray`."""
    wanted = {
        (column.array.name, part): column.array for column, part in zip(columns, parts, strict=True)
    }
    for (_, ends), array in wanted.items():
        part = [slice(0, side) for side in array.shape]
        part[array.time_axis] = slice(*ends)
        array.check(tuple(part))


def check_present(column: Column, stored: Samples, first: int, rate_hz: float) -> None:
    """Refuse samples that the file says are missing.

    Raises
    ------
    ParameterError
        Some are; the line says how many and where.
    """
    absent = missing(stored, column.array.attributes)
    if absent is not None:
        where, reason = absent
        sample = first + int(np.flatnonzero(where)[0])
        raise ParameterError(
            f"channel {column.name!r}: {np.count_nonzero(where)} of {stored.size} samples are "
            f"missing ({reason}), the first is sample {sample + 1} "
            f"({sample / rate_hz:.9g} s): choose a part without them by from_s and to_s"
        )


def stored_limits(
    columns: Sequence[Column], stored: Sequence[Samples], line: TimeLine
) -> list[tuple[float, float] | None]:
    """Range of a recorder's whole numbers by channel; packed values fill theirs by intent."""
    kinds = [values.dtype for values in stored]
    return [
        (float(np.iinfo(kind).min), float(np.iinfo(kind).max))
        if kind.kind == "i" and not is_packed(column.array.attributes) and not line.is_resampled(n)
        else None
        for n, (column, kind) in enumerate(zip(columns, kinds, strict=True))
    ]
