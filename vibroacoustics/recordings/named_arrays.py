"""Channels, time axis and sample rate among the named arrays of a MAT, HDF5 or netCDF file."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .quantities import time_factor
from .recorded import (
    MINIMUM_SAMPLES,
    Recorded,
    Request,
    Samples,
    check_size,
    even_rate_hz,
    listed,
    numbered,
)

RATE_NAMES: Final = ("sample_rate_hz", "sample_rate", "fs", "Fs")
TIME_NAMES: Final = ("time", "time_s", "t")
UNIT_NAMES: Final = ("units", "unit")
MAXIMUM_COLUMNS: Final = 10_000
OWN_NAMES: Final = frozenset({"signal", "channel", "channel_unit"})
"""Variables of a recording that we wrote as netCDF (vocabulary.py)."""


@dataclass(frozen=True)
class NamedArray:
    """An array in a file: what its header says, and how to read its values."""

    name: str
    shape: tuple[int, ...]
    is_number: bool
    load: Callable[[], Any]
    attributes: Mapping[str, Any] = field(default_factory=dict)

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
    check_size(len(columns), columns[0].samples)
    stated = _stated_rate_hz(by_name, columns, attributes)
    loaded = {column.array.name: _load(column) for column in columns}
    return Recorded(
        names=[column.name for column in columns],
        units=[column.unit for column in columns],
        samples=[loaded[column.array.name][column.index] for column in columns],
        sample_rate_hz=_rate_hz(time, stated, request),
        start_time=as_text(attributes.get("start_time", "")),
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
    stored = np.asarray(array.load())
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


def _load(column: _Column) -> Samples:
    """Values of the column's array, shape (channel, time)."""
    values = np.asarray(column.array.load()).reshape(column.array.shape)
    return np.atleast_2d(np.moveaxis(values, column.time_axis, -1))


def _stated_rate_hz(
    by_name: Mapping[str, NamedArray], columns: Sequence[_Column], attributes: Mapping[str, Any]
) -> float | None:
    """Sample rate from an attribute of the file or of the channels, or from a scalar."""
    stated = [attributes[name] for name in RATE_NAMES if name in attributes]
    for column in columns:
        stated += [column.array.attributes[n] for n in RATE_NAMES if n in column.array.attributes]
    scalars = [by_name[name] for name in RATE_NAMES if name in by_name]
    stated += [a.load() for a in scalars if a.is_number and np.prod(a.shape) == 1]
    rates = {float(np.asarray(value, dtype=float).item()) for value in stated}
    if len(rates) > 1:
        raise ParameterError(f"states several sample rates: {sorted(rates)} Hz; choose channels")
    return rates.pop() if rates else None


def _rate_hz(time: NamedArray | None, stated: float | None, request: Request) -> float:
    if time is None:
        rate = request.sample_rate_hz or stated
        if rate is None:
            raise ParameterError(
                "states no sample rate: needs a time vector in s "
                f"({', '.join(TIME_NAMES)}) or a number ({', '.join(RATE_NAMES)}); "
                "or give sample_rate_hz"
            )
        return rate
    factor = time_factor(as_text(time.attributes.get("units", "s")))
    axis = np.asarray(time.load(), dtype=float).ravel() * factor
    rate = even_rate_hz(axis, request)
    if stated is None or request.sample_rate_hz is not None:
        return rate
    if not abs(stated / rate - 1.0) * axis.size <= 1.0:  # they differ by more than a sample
        raise ParameterError(
            f"states a sample rate of {stated:.9g} Hz, but its time axis has {rate:.9g} Hz: "
            "give sample_rate_hz"
        )
    return stated
