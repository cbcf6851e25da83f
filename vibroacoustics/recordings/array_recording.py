"""The recording that named arrays hold."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from ..base.errors import ParameterError
from .array_columns import (
    Column,
    check_claims,
    check_lengths,
    check_present,
    columns_of,
    limits,
    own_columns,
    stored_samples,
)
from .array_times import leading_time, part_of, stated_rate_hz, time_of
from .named_arrays import NamedArray, as_text, is_time
from .packing import unpacked
from .recorded import Recorded, Request, check_size, listed

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
    columns = own_columns(by_name) if by_name.keys() >= OWN_NAMES else columns_of(arrays)
    columns, time, remarks = _with_time(arrays, columns, attributes)
    if not columns:
        raise ParameterError(
            f"holds no vector of numbers beside the time; its variables: {listed(list(by_name))}"
        )
    columns = [columns[index] for index in request.chosen([column.name for column in columns])]
    if not columns:
        raise ParameterError("no channel is chosen")
    time = time or time_of(arrays, columns)
    check_lengths(columns, time)
    stated = stated_rate_hz(arrays, columns, attributes)
    first, last, rate_hz = part_of(time, stated, columns[0].samples, request)
    check_claims(columns, *request.planned(columns[0].samples, rate_hz))
    check_size(len(columns), last - first)
    stored = stored_samples(columns, first, last)
    for column, values in zip(columns, stored, strict=True):
        check_present(column, values, first, rate_hz)
    return Recorded(
        names=[column.name for column in columns],
        units=[column.unit for column in columns],
        samples=[unpacked(v, c.array.attributes) for c, v in zip(columns, stored, strict=True)],
        sample_rate_hz=rate_hz,
        start_time=as_text(attributes.get("start_time", "")),
        first_sample=first,
        total_samples=columns[0].samples,
        limits=[limits(c, v) for c, v in zip(columns, stored, strict=True)],
        remarks=remarks,
    )


def _with_time(
    arrays: Sequence[NamedArray], columns: Sequence[Column], attributes: Mapping[str, Any]
) -> tuple[list[Column], NamedArray | None, list[str]]:
    """Channels, their time where it is the first column of the only table, and remarks."""
    is_named = any(is_time(array.name) for array in arrays)
    time = None if is_named or not columns else leading_time(columns)
    if time is None:
        return list(columns), None, []
    stated = stated_rate_hz(arrays, columns, attributes)
    remark = f"{time.name} grows evenly and is taken as the time in s"
    return list(columns[1:]), time, [] if stated else [remark]
