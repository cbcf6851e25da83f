"""Names, units and form of a table of numbers, from the lines above them."""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.csv_text import fused
from ..base.errors import ParameterError, StorageError
from .quantities import TIME_UNITS, find_quantity

_STAMP: Final = re.compile(
    r"\s*\"?(?P<date>[0-9]{4}-[0-9]{2}-[0-9]{2})[T ]"
    r"(?P<time>[0-9]{2}:[0-9]{2}(?::[0-9]{2}(?:[.,][0-9]+)?)?)"
    r"(?P<zone>Z|[+-][0-9]{2}:?[0-9]{2})?\"?\s*"
)


def is_stamp(field: str) -> bool:
    """Whether a field of a table is a time stamp."""
    return _STAMP.fullmatch(field) is not None


def stamp_text(field: str) -> str:
    """A time stamp as ISO 8601 writes it, with `T` and a point."""
    match = _STAMP.fullmatch(field)
    if match is None:
        raise ValueError(f"{field!r} is no time stamp")
    return f"{match['date']}T{match['time'].replace(',', '.')}{match['zone'] or ''}"


def stamp_ns(field: str) -> int:
    """Nanoseconds of a time stamp since 1970, of UTC where it states its offset.

    Raises
    ------
    ValueError
        The field is no time stamp.
    """
    match = _STAMP.fullmatch(field)
    if match is None:
        raise ValueError(f"{field!r} is no time stamp")
    local = np.datetime64(f"{match['date']}T{match['time'].replace(',', '.')}", "ns")
    return int(local.astype(np.int64)) - 60_000_000_000 * _offset_minutes(match["zone"] or "Z")


def _offset_minutes(zone: str) -> int:
    if zone == "Z":
        return 0
    minutes = 60 * int(zone[1:3]) + int(zone[-2:])
    return -minutes if zone[0] == "-" else minutes


MISSING_TIME: Final = "has no column 'time [s]': add one or give sample_rate_hz"
SEPARATORS: Final = ("\t", ";", ",")
_TIME_NAMES: Final = {"time", "t"}
_BRACKETS: Final = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))")


@dataclass(frozen=True)
class Head:
    """What stands above the numbers.

    Attributes
    ----------
    names, units : of the columns
    separator : of the columns
    has_decimal_comma : whether numbers are written with one
    lines : above the numbers
    stamps : column of time stamps; None without one
    """

    names: Sequence[str]
    units: Sequence[str]
    separator: str
    has_decimal_comma: bool
    lines: int
    stamps: int | None


def read_head(lines: Sequence[str]) -> Head:
    """What stands above the numbers of a table.

    Raises
    ------
    ParameterError
        The row of names is missing or has another number of columns than the table.
    StorageError
        There is no row of numbers.
    """
    for separator in SEPARATORS:
        rows = [_fields(line, separator) for line in lines]
        for number, fields in enumerate(rows):
            if (len(fields) > 1 or separator == ",") and _are_numbers(fields, separator):
                names, units = _parse_names(rows[:number], len(fields))
                is_comma = separator != "," and any("," in line for line in lines[number:])
                stamps = [column for column, field in enumerate(fields) if is_stamp(field)]
                return Head(
                    names, units, separator, is_comma, number, stamps[0] if stamps else None
                )
    raise StorageError(f"has no row of numbers in its first {len(lines)} lines")


def _fields(line: str, separator: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=separator), [])
    except csv.Error as error:
        raise StorageError(f"line {line[:40]!r} cannot be split: {error}") from None


def _are_numbers(fields: Sequence[str], separator: str) -> bool:
    """Whether a row is one of numbers; one of several may be a time stamp."""
    plain = [field if separator == "," else field.replace(",", ".") for field in fields]
    stamps = sum(is_stamp(field) for field in plain)
    return bool(plain) and stamps < min(2, len(plain)) and all(map(_is_number, plain))


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return is_stamp(field)
    return True


def _parse_names(rows: list[list[str]], columns: int) -> tuple[list[str], list[str]]:
    """Names and units from the last rows above the numbers; a row of units may stand below."""
    above = [[field.strip() for field in row] for row in rows if any(f.strip() for f in row)]
    if not above:
        raise ParameterError("has no header row: write 'time [s]' and 'name [unit]' above")
    units = None
    if len(above) > 1 and all(_is_unit(field) for field in above[-1]):
        units = [field.strip("[]()") for field in above.pop()]
    named = [_split_name(fused(field)) for field in above[-1]]
    if len(named) != columns or (units is not None and len(units) != columns):
        raise ParameterError(f"the header names {len(named)} columns, the table has {columns}")
    return [name for name, _ in named], units or [unit for _, unit in named]


def _is_unit(field: str) -> bool:
    plain = field.strip("[]()")
    return not plain or plain in TIME_UNITS or find_quantity(plain) is not None


def _split_name(field: str) -> tuple[str, str]:
    """Name and unit; round brackets count as part of the name where they hold no unit."""
    match = _BRACKETS.fullmatch(field)
    if match is None or (match["square"] is None and not _is_unit(match["round"])):
        return field, ""
    return match["name"], (match["square"] or match["round"] or "").strip()


def time_column(head: Head) -> int | None:
    """The column named time, or whose unit is that of a time, or the one of time stamps.

    Raises
    ------
    ParameterError
        There are several.
    """
    time_columns = [
        column
        for column, (name, unit) in enumerate(zip(head.names, head.units, strict=True))
        if column != head.stamps and (name.lower() in _TIME_NAMES or unit in TIME_UNITS)
    ]
    if len(time_columns) > 1:
        raise ParameterError(
            f"columns {[head.names[column] for column in time_columns]} are all times"
        )
    return time_columns[0] if time_columns else head.stamps
