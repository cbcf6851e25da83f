"""Names, units and form of a table of numbers, from the lines above them."""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Final

from ..base.csv_form import (
    COMMENT,
    GROUPED,
    SEPARATORS,
    NumberForm,
    cells_of,
    number_form,
    split_head,
    tidy,
)
from ..base.csv_text import STATED, fused
from ..base.errors import ParameterError, StorageError
from .quantities import find_quantity, find_time_factor
from .recorded import listed
from .time_stamps import is_stamp

_DECIMAL: Final = re.compile(r"(decimal[ _-]?(?:separator|sign|symbol|mark))", re.IGNORECASE)
_DECIMAL_WORD: Final = re.compile(r"\b(?:comma|point|dot|period)\b", re.IGNORECASE)
_DECIMALS: Final = {"comma": ",", "point": ".", "dot": ".", "period": "."}
BLANK: Final = " "
"""Separator of columns between which there are blanks."""
COMMENTS: Final = (COMMENT, "%")
_BLANK_CELL: Final = re.compile(r"[^\s\[(]\S*(?:\s*(?:\[[^\]]*\]|\([^)]*\)))?|\[[^\]]*\]|\([^)]*\)")
MISSING_TIME: Final = "has no column 'time [s]': add one or give sample_rate_hz"
_EVEN: Final = 1.5
"""Largest step of a column of times without a name, over the smallest."""
_TIME_NAMES: Final = {"time", "t", "zeit", "timestamp", "timestamps", "elapsed time", "x_value"}


@dataclass(frozen=True)
class Head:
    """Head above the numbers.

    Attributes
    ----------
    names, units : names and units of the columns
    separator : separator of the columns
    lines : above the numbers
    stamps : column of time stamps; None without one
    sample : first rows of numbers
    decimal : decimal sign that a line above states; None without one
    is_headless : whether there are no names
    """

    names: Sequence[str]
    units: Sequence[str]
    separator: str
    lines: int
    stamps: int | None
    sample: Sequence[Sequence[str]]
    decimal: str | None = None
    is_headless: bool = False

    @cached_property
    def is_count(self) -> bool:
        """Whether the first column counts the rows."""
        first = [row[0] for row in self.sample]
        return all(cell.isdigit() for cell in first) and _steps(first) == {1.0}

    @cached_property
    def form(self) -> NumberForm:
        """Signs of the numbers.

        Raises
        ------
        ParameterError
            The first rows contradict each other or the lines above, or a cell may be two numbers.
        """
        numbers = [c for row in self.sample for n, c in enumerate(row) if n != self.stamps]
        try:
            form = number_form(numbers, self.separator)
        except ValueError as error:
            raise ParameterError(error.args[0]) from None
        signed = next((cell for cell in numbers if "." in cell or "," in cell), None)
        if signed is not None and self.decimal not in (None, form.decimal):
            raise ParameterError(
                f"states {self.decimal!r} as the decimal sign above numbers such as {signed}: "
                "correct the line or the numbers"
            )
        return form

    @cached_property
    def is_plain(self) -> bool:
        """Whether a line is numbers of Python but for a decimal comma."""
        cells = [cell for row in self.sample for cell in row]
        is_special = self.stamps is not None or self.form.grouped
        is_quoted = self.separator == self.form.decimal
        return not (is_special or is_quoted) and cells == list(map(tidy, cells))

    def cells(self, line: str) -> list[str]:
        """Cells of a row of numbers, as Python writes them."""
        cells = _cells(line.strip("\r\n"), self.separator)
        while len(cells) > len(self.names) and not cells[-1]:
            cells.pop()
        return [c if n == self.stamps else self.form.python(c) for n, c in enumerate(cells)]


def read_head(lines: Sequence[str], is_text: bool = False) -> Head:
    """Find names, units and separator above the numbers of a table.

    Parameters
    ----------
    lines : first lines of the file
    is_text : whether blanks may separate the columns, and names may be missing

    Raises
    ------
    ParameterError
        The row of names is missing or has another number of columns than the table.
    StorageError
        There is no row of numbers.
    """
    stated = STATED.fullmatch(lines[0].strip("\ufeff \r\n")) if lines else None
    separators = SEPARATORS if stated is None else (stated[1],)
    candidates = [(each, 2) for each in separators] + [(BLANK, 2)] * (is_text and not stated)
    if "," in separators:
        candidates.append((",", 1))  # blanks in a number are between its thousands
    for separator, least in candidates:
        rows = [_row(line, separator) for line in lines]
        for number, fields in enumerate(rows):
            if len(fields) >= least and _are_numbers(fields):
                above = _with_date(rows[:number], lines[number], separator, len(fields))
                is_headless = is_text and not _named(above, len(fields))
                if is_headless:
                    columns = range(1, len(fields) + 1)
                    names, units = [f"column {c}" for c in columns], [""] * len(fields)
                else:
                    names, units = _parse_names(above, len(fields))
                stamps = [column for column, field in enumerate(fields) if is_stamp(field)]
                sample = [row for row in rows[number:] if _are_numbers(row)]
                first = stamps[0] if stamps else None
                decimal = _stated_decimal(lines[:number])
                return Head(names, units, separator, number, first, sample, decimal, is_headless)
    words = f" of cells between {stated[1]!r}, as it states" if stated else ""
    raise StorageError(f"has no row of numbers{words} in its first {len(lines)} lines")


def _stated_decimal(lines: Sequence[str]) -> str | None:
    """Decimal sign that a line above the names states; None without one."""
    for line in lines:
        _, name, behind = _DECIMAL.split(line, maxsplit=1) if _DECIMAL.search(line) else ("",) * 3
        word = _DECIMAL_WORD.search(behind)
        if word is not None:
            return _DECIMALS[word[0].lower()]
        signs = behind.strip(' \t\r\n;:|="')  # of commas alone the first may separate cells
        if name and signs and set(signs) <= set('.,"'):
            return "." if "." in signs else ","
    return None


def _row(line: str, separator: str) -> list[str]:
    """Cells of a line above or among the numbers, without blank ones at its end."""
    try:
        cells = _cells(line, separator)
    except ValueError as error:
        raise StorageError(f"line {line[:40]!r} {error}") from None
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _cells(line: str, separator: str) -> list[str]:
    """Cells of a line; a date and the clock beside it are one."""
    return _with_stamps(_plain_cells(line, separator))


def _plain_cells(line: str, separator: str) -> list[str]:
    if separator == BLANK:
        marks = "".join(COMMENTS) if line[:1] in COMMENTS else ""
        cells = _BLANK_CELL.findall(line.lstrip(f"{marks} "))
        return [line[0] + cells[0], *cells[1:]] if marks and cells else cells
    try:
        return cells_of(line, separator, strict=False)
    except csv.Error as error:
        raise ValueError(f"cannot be split: {error}") from None


def _with_stamps(cells: list[str]) -> list[str]:
    for index, (first, second) in enumerate(pairwise(cells)):
        if (":" in first) == (":" in second) or not is_stamp(first if ":" in first else second):
            continue
        stamp = f"{second} {first}" if ":" in first else f"{first} {second}"
        if is_stamp(stamp):
            return [*cells[:index], stamp, *cells[index + 2 :]]
    return cells


def _with_date(above: list[list[str]], line: str, separator: str, columns: int) -> list[list[str]]:
    """Rows above, with one name for the date and the clock of a row of numbers."""
    cells = _plain_cells(line, separator)
    if _with_stamps(cells) == cells:
        return above
    first = next(n for n, c in enumerate(_with_stamps(cells)) if c != cells[n])
    return [
        [*row[:first], " ".join(row[first : first + 2]).strip(), *row[first + 2 :]]
        if len(row) == columns + 1
        else row
        for row in above
    ]


def _steps(cells: Sequence[str]) -> set[float]:
    return {float(b) - float(a) for a, b in pairwise(cells)}


def _named(above: list[list[str]], columns: int) -> bool:
    """Whether a row above has names: any that is no comment, or a comment of as many cells."""
    is_comment = [row[0].startswith(COMMENTS) for row in above if row]
    last = next((row for row in reversed(above) if row), [])
    return not all(is_comment) or len(last) == columns


def _are_numbers(fields: Sequence[str]) -> bool:
    """Whether a row is one of numbers; one of several may be a time stamp."""
    stamps = sum(map(is_stamp, fields))
    return bool(fields) and stamps < min(2, len(fields)) and all(map(_is_number, fields))


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return is_stamp(field) or any(form.fits(tidy(field)) for form in GROUPED)
    return True


def _parse_names(rows: list[list[str]], columns: int) -> tuple[list[str], list[str]]:
    """Names and units from the last rows above the numbers; a row of units may stand below."""
    remarks = [row for row in rows if row and row[0].startswith(COMMENTS)]
    above = [row for row in rows if row and row not in remarks]
    if remarks and (not above or len(above[-1]) < columns == len(remarks[-1])):
        above = [[remarks[-1][0].lstrip(f"{''.join(COMMENTS)} "), *remarks[-1][1:]]]
    if not above:
        raise ParameterError("has no header row: write 'time [s]' and 'name [unit]' above")
    units = None
    if len(above) > 1 and all(_is_unit(field) for field in above[-1]):
        units = [field.strip("[]()") for field in above.pop()]
        units += [""] * (len(above[-1]) - len(units))
    named = [split_head(fused(field), _is_unit) for field in above[-1]]
    if len(named) != columns or (units is not None and len(units) != columns):
        raise ParameterError(
            f"the header names {len(named)} columns ({listed([name for name, _ in named])}), the "
            f"table has {columns}"
        )
    return [name for name, _ in named], units or [unit or "" for _, unit in named]


def _is_unit(field: str) -> bool:
    plain = field.strip("[]()")
    is_time = find_time_factor(plain) is not None
    return not plain or is_time or find_quantity(plain) is not None


def time_column(head: Head) -> int | None:
    """The column named time, else the one whose unit is that of a time, or that of time stamps.

    Raises
    ------
    ParameterError
        There are several.
    """
    others = [column for column in range(len(head.names)) if column != head.stamps]
    time_columns = [c for c in others if head.names[c].lower() in _TIME_NAMES]
    time_columns = time_columns or [c for c in others if find_time_factor(head.units[c])]
    if len(time_columns) > 1:
        raise ParameterError(
            f"columns {[head.names[column] for column in time_columns]} are all times"
        )
    if time_columns or head.stamps is not None:
        return time_columns[0] if time_columns else head.stamps
    return 0 if head.is_headless and len(head.names) > 1 and _grows(head) else None


def _grows(head: Head) -> bool:
    """Whether the first column of a table without names grows by nearly equal steps."""
    steps = _steps([head.form.python(row[0]) for row in head.sample])
    return bool(steps) and min(steps) > 0.0 and max(steps) < _EVEN * min(steps)
