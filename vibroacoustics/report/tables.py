"""Tables: rows for readers as Markdown and plain text, columns for programs as CSV."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias

import numpy as np
import xarray as xr

from ..base.csv_text import csv_bytes
from ..base.visible import visible
from ..results.number import Number

Cell: TypeAlias = str | Number
DataTable: TypeAlias = Mapping[str, Sequence[str | float]]
"""Values by machine-readable names of columns; an empty text is no value."""
Record: TypeAlias = Mapping[str, Any]
"""Values of a row by their names."""
Columns: TypeAlias = Sequence[tuple[str, str, Callable[[Any], Cell]]]
"""Head of each column, name of its value in a record, and what writes it."""
_IN_ASCII: Final = str.maketrans(
    {"−": "-", "–": "-", "\u00a0": " ", "\n": " ", "×": "x", "Δ": "change "}
)
WIDEST_FIRST: Final = 40
"""Letters of the first column in a terminal."""


@dataclass(frozen=True)
class Table:
    """Rows of finished text and numbers under a head; the first column names the row."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    words: frozenset[int] = frozenset({0})
    """Columns of words, set flush left; numbers are set flush right."""
    block: Literal["table"] = field(default="table", kw_only=True, repr=False)


def to_csv(table: DataTable) -> bytes:
    """Return a table as CSV with a head line; numbers to nine significant digits."""
    rows = zip(*table.values(), strict=True)
    return csv_bytes(list(table), rows, lambda number: f"{number:.9g}")


def cell(value: str | float | None) -> str | float:
    """Return a cell of a CSV: empty where there is no value, or where it is not a number."""
    return "" if value is None or (isinstance(value, float) and np.isnan(value)) else value


def without_nan(table: DataTable) -> DataTable:
    """Return a table with empty cells where a number is not known."""
    return {head: list(map(cell, values)) for head, values in table.items()}


def columns_of(head: Sequence[str], rows: Iterable[Sequence[str | float]]) -> DataTable:
    """Return rows as columns."""
    listed = list(rows)
    columns = zip(*listed, strict=True) if listed else ([] for _ in head)
    return dict(zip(head, columns, strict=True))


def table_of(
    caption: str, rows: Iterable[Record], columns: Columns, words: frozenset[int] = frozenset({0})
) -> Table:
    """Table of records: a row for each, with the values that the columns name."""
    cells = tuple(tuple(write(row[name]) for _, name, write in columns) for row in rows)
    return Table(caption, tuple(head for head, _, _ in columns), cells, words)


def data_table(dims: Sequence[str], columns: Mapping[str, xr.DataArray]) -> DataTable:
    """Return a table with a row for each point of some dimensions, the last of which runs fastest.

    Each column is over some of the dimensions.
    """
    sizes = {dim: size for array in columns.values() for dim, size in array.sizes.items()}
    shape = [sizes[dim] for dim in dims]
    values = {}
    for name, array in columns.items():
        kept = [dim for dim in dims if dim in array.dims]
        beside = array.variable.transpose(*kept).values.reshape(
            [sizes[dim] if dim in kept else 1 for dim in dims]
        )
        values[name] = np.broadcast_to(beside, shape).ravel().tolist()
    return values


def records(table: DataTable) -> list[Record]:
    """Return the rows of a table."""
    return [dict(zip(table, row, strict=True)) for row in zip(*table.values(), strict=True)]


def long_table(results: xr.Dataset, names: Iterable[str], **labels: Any) -> DataTable:
    """Return variables of any dimensions below one another, a row for each value that is a number.

    Some variables may be missing; labels are those of dimensions that are selected.
    """
    arrays = [
        results[name].sel({dim: labels[dim] for dim in results[name].dims if dim in labels})
        for name in names
        if name in results
    ]
    dims = list(dict.fromkeys(str(dim) for array in arrays for dim in array.dims))
    rows: list[list[str | float]] = []
    for array in arrays:
        unit = str(array.attrs.get("units", ""))
        for index in np.argwhere(np.isfinite(array.values)):
            point = array[tuple(index)]
            cells = [point[dim].item() if dim in array.dims else "" for dim in dims]
            rows.append([str(array.name), unit, *cells, point.item()])
    return columns_of(("quantity", "unit", *dims, "value"), rows)


def amplitude(value: float) -> str:
    """Four digits of any unit: accelerations in m/s² and displacements in m alike."""
    return f"{value:.4g}"


def phase_deg(peaks: xr.DataArray) -> xr.DataArray:
    """Phase of complex amplitudes, degrees."""
    return peaks.copy(data=np.degrees(np.angle(peaks.values)))


def to_markdown(table: Table) -> str:
    """Pipe table below its caption."""
    rule = ["---" if column in table.words else "---:" for column in range(len(table.head))]
    lines = [_pipes(table.head), _pipes(rule), *(_pipes(row) for row in table.rows)]
    return "\n".join([f"**{escape_markdown(table.caption)}**", "", *lines])


def to_text(table: Table) -> str:
    """Return columns of ASCII-only text below the caption, for a terminal."""
    if not table.rows:
        return to_ascii(table.caption)
    rows = [[to_ascii(str(cell)) for cell in row] for row in (table.head, *table.rows)]
    for row in rows:
        if len(row[0]) > WIDEST_FIRST:
            row[0] = f"{row[0][: WIDEST_FIRST - 3]}..."
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(
            cell.ljust(width) if column in table.words else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    return "\n".join([to_ascii(table.caption), lines[0], "-" * len(lines[0]), *lines[1:], ""])


def escape_markdown(text: str) -> str:
    """Text on one line that Markdown shows as it is."""
    text = visible(text)
    for character in "\\`*_[]|":
        text = text.replace(character, f"\\{character}")
    return text.replace("<", "&lt;").replace("\n", " ")


def _pipes(cells: Iterable[Cell]) -> str:
    return "| " + " | ".join(escape_markdown(str(cell)) for cell in cells) + " |"


def to_ascii(text: str) -> str:
    """Return text with ASCII in place of the signs of numbers."""
    return visible(text).translate(_IN_ASCII)
