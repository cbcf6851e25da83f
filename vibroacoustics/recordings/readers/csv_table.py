"""CSV: columns `name [unit]`, one of them the time; comma, semicolon or tab; decimal comma."""

import csv
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import BinaryIO, Final

import numpy as np

from ...base.csv_text import fused
from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..quantities import TIME_UNITS, find_quantity, time_factor
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size
from ..time_axis import even_rate_hz

MAXIMUM_LINE_BYTES: Final = 2**16
MAXIMUM_HEAD_LINES: Final = 200
SEPARATORS: Final = ("\t", ";", ",")
_TIME_NAMES: Final = {"time", "t"}
_BRACKETS: Final = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))")


@dataclass(frozen=True)
class _Head:
    """What stands above the numbers."""

    names: Sequence[str]
    units: Sequence[str]
    separator: str
    has_decimal_comma: bool
    lines: int


def read(request: Request) -> Recorded:
    """Columns of a table; its time column gives the sample rate.

    Raises
    ------
    ParameterError
        There is no header, no time column, or the times are not even.
    StorageError
        The table has a gap, a line too long or columns of different lengths.
    """
    with request.path.open("rb") as file:
        head = _read_head(file)
    table = _read_numbers(request.path, head)
    check_size(len(head.names), len(table))
    rate = request.sample_rate_hz
    time_column = _time_column(head)
    if time_column is not None:
        rate = even_rate_hz(table[:, time_column] * time_factor(head.units[time_column]), request)
    if rate is None:
        raise ParameterError("has no column 'time [s]': add one or give sample_rate_hz")
    columns = [column for column in range(len(head.names)) if column != time_column]
    columns = [columns[index] for index in request.chosen([head.names[c] for c in columns])]
    return Recorded(
        names=[head.names[column] for column in columns],
        units=[head.units[column] for column in columns],
        samples=[table[:, column] for column in columns],
        sample_rate_hz=rate,
    )


def _read_head(file: BinaryIO) -> _Head:
    lines = [_text(line) for line in islice(_lines(file), MAXIMUM_HEAD_LINES)]
    for separator in SEPARATORS:
        rows = [_fields(line, separator) for line in lines]
        for number, fields in enumerate(rows):
            if (len(fields) > 1 or separator == ",") and _are_numbers(fields, separator):
                names, units = _parse_names(rows[:number], len(fields))
                is_comma = separator != "," and any("," in line for line in lines[number:])
                return _Head(names, units, separator, is_comma, number)
    raise StorageError(f"has no row of numbers in its first {len(lines)} lines")


def _lines(file: BinaryIO) -> Iterator[bytes]:
    number = 0
    while line := file.readline(MAXIMUM_LINE_BYTES):
        number += 1
        if len(line) == MAXIMUM_LINE_BYTES:
            raise StorageError(f"line {number} is longer than {MAXIMUM_LINE_BYTES} bytes")
        yield line


def _text(line: bytes) -> str:
    try:
        return line.decode("utf-8-sig")
    except UnicodeDecodeError:  # as Western European spreadsheets write m/s²
        return line.decode("latin-1")


def _fields(line: str, separator: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=separator), [])
    except csv.Error as error:
        raise StorageError(f"line {line[:40]!r} cannot be split: {error}") from None


def _are_numbers(fields: Sequence[str], separator: str) -> bool:
    try:
        for field in fields:
            float(field if separator == "," else field.replace(",", "."))
    except ValueError:
        return False
    return bool(fields)


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


def _time_column(head: _Head) -> int | None:
    """The column named time, or the one whose unit is that of a time."""
    time_columns = [
        column
        for column, (name, unit) in enumerate(zip(head.names, head.units, strict=True))
        if name.lower() in _TIME_NAMES or unit in TIME_UNITS
    ]
    if len(time_columns) > 1:
        raise ParameterError(
            f"columns {[head.names[column] for column in time_columns]} are all times"
        )
    return time_columns[0] if time_columns else None


def _read_numbers(path: Path, head: _Head) -> Samples:
    with path.open(encoding="latin-1", newline="\n") as file:
        pieces = iter(partial(file.readline, MAXIMUM_LINE_BYTES), "")  # of a line without end
        lines: Iterator[str] = islice(pieces, head.lines, None)
        if head.has_decimal_comma:
            lines = (line.replace(",", ".") for line in lines)
        try:
            return np.loadtxt(lines, delimiter=head.separator, comments=None, ndmin=2)
        except ValueError as error:
            reason = str(error).split("; use `")[0]
            raise StorageError(f"below its {head.lines} header lines: {reason}") from None


register(Reader("csv", (".csv", ".txt"), "CSV", read))
