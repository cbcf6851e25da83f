"""Columns of numbers and words from a CSV file of the user, by names with units."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from .arrays import Array
from .column_head import Column, Head, Layout, find_head, with_units
from .csv_form import NumberForm, number_form, tidy
from .csv_text import MAXIMUM_BYTES, read_lines
from .errors import ParameterError


@dataclass(frozen=True)
class Columns:
    """Content of a file's columns.

    Attributes
    ----------
    path : path of the file
    numbers : in SI by SI name, shape (row,)
    texts : columns of words by name, one text a row
    lines : number of each row's line
    """

    path: Path
    numbers: dict[str, Array]
    texts: dict[str, tuple[str, ...]]
    lines: tuple[int, ...]

    def origin(self, row: int) -> str:
        """File and line of a row."""
        return f"{self.path}: line {self.lines[row]}"

    def refusal(self, row: int, words: str) -> ParameterError:
        """Return the error to raise for a row."""
        return ParameterError(f"{self.origin(row)}: {words}")


def read_columns(
    path: str | Path,
    numbers: Sequence[str],
    optional: Sequence[str] = (),
    texts: Sequence[str] = (),
) -> Columns:
    """Read columns of a CSV file by their SI names; lines that begin with # are comments.

    A column may be in any unit of its quantity: `fx_kn`, `Fx [kN]`, `Fx (kN)` and `Fx / kN` are
    `fx_n`. The unit may be in a line below the head. docs/csv.md shows all forms.

    Parameters
    ----------
    path : file with a head line
    numbers : SI names of columns that it must have
    optional : SI names of columns that it may have
    texts : names of columns of words that it may have

    Returns
    -------
    `numbers`, arrays in SI by SI name, and `texts`; `refusal(row, words)` makes the error of a row

    Raises
    ------
    ParameterError
        It cannot be read, lacks a column, has an unknown one, or a cell is no finite number.

    Examples
    --------
    >>> _ = open("stiffness.csv", "w").write("frequency_hz,stiffness_n_per_mm\\n100,50\\n")
    >>> columns = va.read_columns("stiffness.csv", ["frequency_hz", "stiffness_n_per_m"])
    >>> columns.numbers["stiffness_n_per_m"].tolist()  # N/m
    [50000.0]
    """
    return read_layouts(path, [Layout(numbers, optional, texts)])


def read_layouts(
    path: str | Path, layouts: Sequence[Layout], maximum_bytes: int = MAXIMUM_BYTES
) -> Columns:
    """Read columns of a CSV file of one of several layouts; see `read_columns`.

    Parameters
    ----------
    path : file with a head line
    layouts : that it may have; its head decides
    maximum_bytes : largest size of the file
    """
    lines = read_lines(Path(path), maximum_bytes)
    head = find_head(lines, layouts)
    rows = lines.rows(head.separator)[head.row + 1 :]
    numbers, columns = lines.numbers[head.row + 1 :], head.numeric
    if rows and (stated := with_units(head, rows[0])) is not None:
        columns, rows, numbers = stated, rows[1:], numbers[1:]
    for column in [*(each for each in head.columns if head.layout.is_text(each.name)), *columns]:
        column.check(lines.path)
    if not rows:
        raise ParameterError(f"{lines.path}: has no rows under its head")
    for line, row in zip(numbers, rows, strict=True):
        _check_row(f"{lines.path}: line {line}", head, row)
    return Columns(
        lines.path,
        _numbers(lines.path, head, columns, rows, numbers),
        {
            column.name: tuple(row[column.number] for row in rows)
            for column in head.columns
            if head.layout.is_text(column.name)
        },
        numbers,
    )


def _check_row(where: str, head: Head, row: Sequence[str]) -> None:
    """Refuse a row with fewer cells than names, or with a cell under no name."""
    names = max(number for number, cell in enumerate(head.cells) if cell) + 1
    cells = max(number for number, cell in enumerate(row) if cell) + 1
    if len(row) < names or cells > names:
        count = cells if cells > names else len(row)
        decimal = "; with decimal commas, separate cells by semicolons"
        hint = decimal if head.separator == "," and cells > names else ""
        raise ParameterError(f"{where}: {count} cells, the head has {names}{hint}")
    for cell, name in zip(row, head.cells, strict=False):
        if cell and not name:
            raise ParameterError(f"{where}: {cell}: its column has no name")


def _numbers(
    path: Path,
    head: Head,
    columns: Sequence[Column],
    rows: Sequence[Sequence[str]],
    lines: tuple[int, ...],
) -> dict[str, Array]:
    cells = [[row[column.number] for row in rows] for column in columns]
    try:
        form = number_form(chain.from_iterable(cells), head.separator)
    except ValueError as error:
        words, cell = error.args
        column, row = next(
            (c, t.index(cell)) for c, t in zip(columns, _tidy(cells), strict=True) if cell in t
        )
        problem = f"line {lines[row]}: {column.cell} = {words}"
        raise ParameterError(f"{path}: {problem}") from None
    numbers = {}
    for column, texts in zip(columns, cells, strict=True):
        counts = [bool(cell) or column.name not in head.layout.blank for cell in texts]
        values = np.full(len(texts), np.nan)
        try:
            values[counts] = form.numbers(
                [t for t, count in zip(texts, counts, strict=True) if count]
            )
        except ValueError:
            row = next(n for n, cell in enumerate(texts) if counts[n] and _is_bad(form, cell))
            problem = f"{column.cell} = {texts[row] or 'nothing'}: must be a finite number"
            raise ParameterError(f"{path}: line {lines[row]}: {problem}") from None
        numbers[column.name] = (column.factor or 1.0) * values
    return numbers


def _tidy(cells: Sequence[Sequence[str]]) -> list[list[str]]:
    return [[tidy(cell) for cell in texts] for texts in cells]


def _is_bad(form: NumberForm, cell: str) -> bool:
    try:
        form.numbers([cell])
    except ValueError:
        return True
    return False
