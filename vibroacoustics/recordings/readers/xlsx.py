"""XLSX: a table of a spreadsheet, with columns as in a CSV file, through openpyxl."""

import warnings
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from itertools import islice, pairwise
from pathlib import Path
from typing import Any, Final
from zipfile import ZipFile

import numpy as np

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..axes import line_of_times
from ..csv_head import MISSING_TIME, Head, read_head, time_column
from ..named_arrays import is_rate
from ..quantities import time_factor
from ..reader import Reader
from ..recorded import MissingError, Recorded, Request, Samples, check_rate, check_size, listed
from ..time_stamps import stamp_text

MAXIMUM_HEAD_ROWS: Final = 200
MAXIMUM_ROWS: Final = 2**20
"""Rows of a sheet (Office Open XML spreadsheets, limits of their programs)."""
_RATIO: Final = 100
"""Most bytes of a part by a packed byte: the limit of Apache POI, `ZipSecureFile`."""
_FREE_BYTES: Final = 100_000
"""Size below which a part may have any ratio, as there."""
_Row = tuple[Any, ...]


@dataclass(frozen=True)
class _Sheet:
    """A table of one sheet.

    Attributes
    ----------
    title : title of the sheet
    head : names, units and rows above the numbers
    columns : columns of the table's fields among the cells of a row
    rate_hz : sample rate from a row above the names; None without one
    """

    title: str
    head: Head
    columns: Sequence[int]
    rate_hz: float | None


def read(request: Request) -> Recorded:
    """Columns of the first sheet that holds a table of numbers."""
    from openpyxl import load_workbook

    _check_parts(request.path)
    with warnings.catch_warnings(action="ignore"):
        book = load_workbook(request.path, read_only=True, data_only=True, keep_links=False)
        sheet, remarks = _sheet(book)
        head, time = sheet.head, time_column(sheet.head)
        fields = [c for c in range(len(head.names)) if c not in (time, head.stamps)]
        names, units = [head.names[c] for c in fields], [head.units[c] for c in fields]
        remarks += request.omissions(names, units)
        fields = [fields[index] for index in request.chosen(names, units)]
        wanted = fields if time is None else [time, *fields]
        values = _numbers(book[sheet.title], sheet, wanted)
        stamp = _first_stamp(book[sheet.title], sheet)
    names, units = [head.names[c] for c in fields], [head.units[c] for c in fields]
    if time is None:
        samples, rate_hz = list(values.T), _rate_hz(sheet, request)
    else:
        line = line_of_times(names, _times(sheet, time, values), request)
        stored = [values[slice(*part), n + 1] for n, part in enumerate(line.parts)]
        samples, rate_hz = line.on_grid(stored), line.rate_hz
        remarks += line.remarks(units, stored)
    return Recorded(
        names=names,
        units=units,
        samples=samples,
        sample_rate_hz=rate_hz,
        start_time=stamp,
        remarks=remarks,
    )


def _check_parts(path: Path) -> None:
    """Refuse parts that unpack to more than cells do; the directory of the archive states it."""
    with ZipFile(path) as archive:
        for part in archive.infolist():
            if part.file_size > max(_FREE_BYTES, _RATIO * part.compress_size):
                raise StorageError(
                    f"part {part.filename!r} claims {part.file_size} bytes in "
                    f"{part.compress_size} packed ones: cells take a {_RATIO}th at least: save "
                    "the table alone, or as CSV"
                )


def _sheet(book: Any) -> tuple[_Sheet, list[str]]:
    """The first sheet with a table, and what the user must know of others."""
    tables, reasons = [], []
    for sheet in book.worksheets:
        sheet.reset_dimensions()  # programs write wrong ones
        rows = list(islice(sheet.iter_rows(values_only=True), MAXIMUM_HEAD_ROWS))
        columns = sorted({c for row in rows for c, cell in enumerate(row) if cell is not None})
        texts = ["\t".join(_texts(row, columns)) for row in rows]
        try:
            head = read_head(texts)
        except (ParameterError, StorageError) as error:
            reasons.append(f"sheet {sheet.title!r} {error}")
            continue
        rate_hz = _stated_rate_hz(rows[: head.lines])
        tables.append(_Sheet(sheet.title, head, columns, rate_hz))
    if not tables:
        raise StorageError("; ".join(reasons) or "has no sheet")
    others = [table.title for table in tables[1:]]
    lines = [f"sheet {tables[0].title!r} is read, not {listed(others)}"] if others else []
    return tables[0], lines


def _texts(row: _Row, columns: Sequence[int]) -> list[str]:
    """Cells as text; without the empty ones at the end."""
    cells = [row[c] if c < len(row) else None for c in columns]
    while cells and cells[-1] is None:
        cells.pop()
    return [_text(cell) for cell in cells]


def _text(cell: Any) -> str:
    if isinstance(cell, datetime):
        return cell.isoformat(" ")
    plain = "" if cell is None else str(cell)
    return " ".join(plain.split()) if '"' not in plain else " ".join(plain.split()).replace('"', "")


def _stated_rate_hz(rows: Sequence[_Row]) -> float | None:
    """Sample rate of a row such as `Sample rate [Hz] | 51200`."""
    for row in rows:
        cells = [cell for cell in row if cell is not None]
        for name, value in pairwise(cells):
            is_number = isinstance(value, int | float) and not isinstance(value, bool)
            if isinstance(name, str) and is_number and is_rate(name):
                return float(value)
    return None


def _numbers(sheet: Any, table: _Sheet, fields: Sequence[int]) -> Samples:
    """Numbers of some columns, shape (row, column)."""
    values = array("d")
    cells = [table.columns[field] for field in fields]
    stamped = [field == table.head.stamps for field in fields]
    for number, row in _rows(sheet, table):
        for cell, field, is_stamp in zip(cells, fields, stamped, strict=True):
            value = row[cell] if cell < len(row) else None
            if is_stamp and isinstance(value, datetime):
                value = (value - datetime(1970, 1, 1)).total_seconds()
            if isinstance(value, bool) or not isinstance(value, int | float):
                name = table.head.names[field]
                raise StorageError(
                    f"sheet {table.title!r}, row {number}, column {name!r}: {value!r} is no number"
                )
            values.append(value)
    check_size(len(fields), len(values) // max(1, len(fields)))
    return np.frombuffer(values, dtype=float).reshape(-1, len(fields))


def _rows(sheet: Any, table: _Sheet) -> Iterator[tuple[int, _Row]]:
    """Rows of numbers with their numbers in the sheet; empty rows end the table.

    Raises
    ------
    StorageError
        Numbers follow an empty row.
    """
    sheet.reset_dimensions()
    empty = 0
    rows = sheet.iter_rows(min_row=table.head.lines + 1, values_only=True)
    for number, row in enumerate(rows, table.head.lines + 1):
        if number > MAXIMUM_ROWS:
            raise StorageError(
                f"sheet {table.title!r} claims more than the {MAXIMUM_ROWS} rows that a sheet can "
                "hold"
            )
        if all(cell is None for cell in row):
            empty = empty or number
            continue
        if empty:
            raise StorageError(
                f"sheet {table.title!r}: row {empty} is empty and row {number} is not: save each "
                "table as a file"
            )
        yield number, row


def _first_stamp(sheet: Any, table: _Sheet) -> str:
    if table.head.stamps is None:
        return ""
    _, row = next(_rows(sheet, table))
    return stamp_text(_text(row[table.columns[table.head.stamps]]))


def _times(table: _Sheet, time: int, values: Samples) -> Samples:
    unit = "s" if time == table.head.stamps else table.head.units[time]
    return np.asarray((values[:, 0] - values[:1, 0]) * time_factor(unit))


def _rate_hz(table: _Sheet, request: Request) -> float:
    rate_hz = request.sample_rate_hz or table.rate_hz
    if rate_hz is None:
        raise MissingError(MISSING_TIME)
    check_rate(rate_hz)
    return rate_hz


register(Reader("xlsx", (".xlsx", ".xlsm"), "XLSX (spreadsheet)", read, package="openpyxl"))
