"""Channels, time axis and sample rate among the named arrays of a MAT, HDF5 or netCDF file."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .packing import is_packed, missing, unpacked, unsigned
from .quantities import time_factor
from .recorded import (
    MINIMUM_SAMPLES,
    Recorded,
    Request,
    Samples,
    check_rate,
    check_size,
    listed,
    numbered,
)
from .time_axis import even_part

RATE_NAMES: Final = ("sample_rate_hz", "sample_rate", "fs", "Fs")
TIME_NAMES: Final = ("time", "time_s", "t")
UNIT_NAMES: Final = ("units", "unit")
MAXIMUM_COLUMNS: Final = 10_000
OWN_NAMES: Final = frozenset({"signal", "channel", "channel_unit"})
"""Variables of a recording that we wrote as netCDF (vocabulary.py)."""


Part = tuple[slice, ...]
"""One slice a dimension."""


@dataclass(frozen=True)
class NamedArray:
    """An array in a file: what its header says, and how to read its values.

    Attributes
    ----------
    name : with the path to it
    shape : as the header claims it
    is_number : whether it holds numbers
    load : stored values of a part, one slice a dimension
    attributes : units, sample rate and how the values are packed
    """

    name: str
    shape: tuple[int, ...]
    is_number: bool
    load: Callable[[Part], Any]
    attributes: Mapping[str, Any] = field(default_factory=dict)

    def values(self, part: Part | None = None) -> Samples:
        """Values of a part, by default of all; see `unpacked`."""
        every = tuple(slice(0, side) for side in self.shape)
        stored = np.asarray(self.load(every if part is None else part))
        return unpacked(unsigned(stored, self.attributes), self.attributes)

    @property
    def time_axis(self) -> int:
        """The longer side; of a square the last."""
        return int(len(self.shape) == 2 and self.shape[1] >= self.shape[0])

    @property
    def may_be_channels(self) -> bool:
        """Whether it is a vector or table of numbers, with samples enough."""
        return (
            self.is_number
            and len(self.shape) in (1, 2)
            and self.shape[self.time_axis] >= MINIMUM_SAMPLES
        )


@dataclass(frozen=True)
class _Column:
    """One channel: a row or column of an array."""

    name: str
    unit: str
    array: NamedArray
    index: int
    time_axis: int

    @property
    def samples(self) -> int:
        return self.array.shape[self.time_axis]


def recorded(
    arrays: Sequence[NamedArray], attributes: Mapping[str, Any], request: Request
) -> Recorded:
    """The recording that the arrays of a file hold.

    Parameters
    ----------
    arrays : all arrays of the file
    attributes : those of the file itself
    request : channels that are wanted, sample rate that overrides the file's

    Raises
    ------
    ParameterError
        There is no channel, no sample rate, or the channels differ in length.
    StorageError
        The arrays claim more samples than the cap allows.
    """
    by_name = {array.name: array for array in arrays}
    time = next((by_name[name] for name in TIME_NAMES if name in by_name), None)
    columns = _own_columns(by_name) if by_name.keys() >= OWN_NAMES else _columns(arrays, time)
    if not columns:
        raise ParameterError(
            f"holds no vector of numbers beside the time; its variables: {listed(list(by_name))}"
        )
    columns = [columns[index] for index in request.chosen([column.name for column in columns])]
    _check_lengths(columns, time)
    stated = _stated_rate_hz(by_name, columns, attributes)
    samples = columns[0].samples
    first, last, rate_hz = _part(time, stated, samples, request)
    check_size(len(columns), last - first)
    stored = _stored(columns, first, last)
    for column, values in zip(columns, stored, strict=True):
        _check_present(column, values, first, rate_hz)
    return Recorded(
        names=[column.name for column in columns],
        units=[column.unit for column in columns],
        samples=[unpacked(v, c.array.attributes) for c, v in zip(columns, stored, strict=True)],
        sample_rate_hz=rate_hz,
        start_time=as_text(attributes.get("start_time", "")),
        first_sample=first,
        total_samples=samples,
        limits=[_limits(c, v) for c, v in zip(columns, stored, strict=True)],
    )


def as_text(value: Any) -> str:
    """Text of an attribute: bytes and arrays of one element too."""
    value = value.item() if isinstance(value, np.ndarray) and value.size == 1 else value
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _own_columns(by_name: Mapping[str, NamedArray]) -> list[_Column]:
    signal = by_name["signal"]
    names, units = _texts(by_name["channel"]), _texts(by_name["channel_unit"])
    if not len(names) == len(units) == signal.shape[0] or len(signal.shape) != 2:
        raise ParameterError("signal, channel and channel_unit do not belong together")
    return [
        _Column(name, unit, signal, index, 1)
        for index, (name, unit) in enumerate(zip(names, units, strict=True))
    ]


def _texts(array: NamedArray) -> list[str]:
    """Texts that are stored as rows of characters or as whole strings."""
    check_size(1, int(np.prod(array.shape)))
    stored = np.asarray(array.load(tuple(slice(0, side) for side in array.shape)))
    if stored.dtype == np.dtype("S1") and stored.ndim == 2:
        return [row.tobytes().rstrip(b"\0 ").decode("utf-8", "replace") for row in stored]
    return [as_text(text) for text in stored.ravel()]


def _columns(arrays: Sequence[NamedArray], time: NamedArray | None) -> list[_Column]:
    """All channels: vectors by their name, tables by name and number."""
    columns = []
    for array in arrays:
        if array is time or not array.may_be_channels:
            continue
        width = min(array.shape) if len(array.shape) == 2 else 1
        if width > MAXIMUM_COLUMNS:
            raise StorageError(f"variable {array.name!r} claims {array.shape} values: too wide")
        unit = next((as_text(array.attributes[n]) for n in UNIT_NAMES if n in array.attributes), "")
        names = numbered([array.name] * width)
        columns += [
            _Column(name, unit, array, index, array.time_axis) for index, name in enumerate(names)
        ]
    return columns


def _check_lengths(columns: Sequence[_Column], time: NamedArray | None) -> None:
    lengths = {column.name: column.samples for column in columns}
    if time is not None:
        lengths[time.name] = int(np.prod(time.shape))
    if len(set(lengths.values())) > 1:
        listing = [f"{name} {samples}" for name, samples in lengths.items()]
        raise ParameterError(
            f"variables differ in length ({listed(listing)}): choose channels of the same length"
        )


def _stored(columns: Sequence[_Column], first: int, last: int) -> list[Samples]:
    """Stored samples of each column; of a table those columns alone that are wanted, at once."""
    tables: dict[str, tuple[int, Samples]] = {}
    for one in {column.array.name: column for column in columns}.values():
        wanted = [column.index for column in columns if column.array is one.array]
        tables[one.array.name] = min(wanted), _rows(one, min(wanted), max(wanted) + 1, first, last)
    return [
        tables[column.array.name][1][column.index - tables[column.array.name][0]]
        for column in columns
    ]


def _rows(one: _Column, low: int, high: int, first: int, last: int) -> Samples:
    """Stored values of the columns from `low` up to `high` of a table, shape (channel, time)."""
    part = [slice(first, last)]
    if len(one.array.shape) == 2:
        part.insert(1 - one.time_axis, slice(low, high))
    sides = [side.stop - side.start for side in part]
    values = np.asarray(one.array.load(tuple(part))).reshape(sides)
    values = unsigned(values, one.array.attributes)
    return np.atleast_2d(np.moveaxis(values, one.time_axis, -1))


def _check_present(column: _Column, stored: Samples, first: int, rate_hz: float) -> None:
    """Refuse samples that the file says are missing."""
    absent = missing(stored, column.array.attributes)
    if absent is not None:
        where, fill = absent
        sample = first + int(np.flatnonzero(where)[0])
        raise ParameterError(
            f"channel {column.name!r}: {np.count_nonzero(where)} of {stored.size} samples are "
            f"missing (fill value {fill:g}), the first is sample {sample + 1} "
            f"({sample / rate_hz:.9g} s): choose a part without them by from_s and to_s"
        )


def _limits(column: _Column, stored: Samples) -> tuple[float, float] | None:
    """Range of a recorder's whole numbers; packed values fill theirs by intent."""
    if stored.dtype.kind != "i" or is_packed(column.array.attributes):
        return None
    return float(np.iinfo(stored.dtype).min), float(np.iinfo(stored.dtype).max)


def _stated_rate_hz(
    by_name: Mapping[str, NamedArray], columns: Sequence[_Column], attributes: Mapping[str, Any]
) -> float | None:
    """Sample rate from an attribute of the file or of the channels, or from a scalar."""
    stated = [attributes[name] for name in RATE_NAMES if name in attributes]
    for column in columns:
        stated += [column.array.attributes[n] for n in RATE_NAMES if n in column.array.attributes]
    scalars = [by_name[name] for name in RATE_NAMES if name in by_name]
    stated += [a.values() for a in scalars if a.is_number and np.prod(a.shape) == 1]
    rates = {float(np.asarray(value, dtype=float).item()) for value in stated}
    if len(rates) > 1:
        raise ParameterError(f"states several sample rates: {sorted(rates)} Hz; choose channels")
    return rates.pop() if rates else None


def _part(
    time: NamedArray | None, stated: float | None, samples: int, request: Request
) -> tuple[int, int, float]:
    """First sample that is wanted, the one behind the last, and the sample rate."""
    if time is None:
        rate = request.sample_rate_hz or stated
        if rate is None:
            raise ParameterError(
                "states no sample rate: needs a time vector in s "
                f"({', '.join(TIME_NAMES)}) or a number ({', '.join(RATE_NAMES)}); "
                "or give sample_rate_hz"
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
