"""Head of a CSV file: which column of a layout each cell names, and in which unit."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final, NamedTuple

from .csv_form import split_head
from .csv_text import Lines, fused
from .errors import ParameterError
from .unit_spelling import find_unit, plain_unit, symbols
from .units import Unit, si_key, split_key

HEAD_LINES: Final = 50
"""Lines among which the head is looked for."""
LISTED: Final = 20
"""Columns that a message lists."""
NO_UNIT: Final = ("", "-", "1")
"""Texts in place of a unit where there is none."""


@dataclass(frozen=True)
class Layout:
    """Columns that a file may have, by their SI names.

    Attributes
    ----------
    numbers : columns of numbers that it must have
    optional : columns of numbers that it may have
    optional_texts : columns of words that it may have
    texts : columns of words that it must have
    blank : columns of numbers whose cells may be blank: not a number
    """

    numbers: Sequence[str]
    optional: Sequence[str] = ()
    optional_texts: Sequence[str] = ()
    texts: Sequence[str] = ()
    blank: Sequence[str] = ()

    @property
    def needed(self) -> tuple[str, ...]:
        """Names of columns that a file must have."""
        return (*self.texts, *self.numbers)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all columns."""
        return (*self.needed, *self.optional, *self.optional_texts)

    def is_text(self, name: str) -> bool:
        """Whether a column is of words."""
        return name in self.texts or name in self.optional_texts


class Column(NamedTuple):
    """Column of a head.

    Attributes
    ----------
    number : position among the cells
    cell : text of the cell in the head
    name : SI name
    factor : to SI; none where no unit is stated
    problem : why the stated unit does not fit; empty where it does
    """

    number: int
    cell: str
    name: str
    factor: float | None
    problem: str = ""

    def with_unit(self, text: str) -> "Column":
        """Column with the unit that brackets or a line of units state."""
        expected, unit = split_key(self.name)[1], find_unit(text)
        if expected is None:
            return self if text in NO_UNIT else self._replace(problem=f"unit {text}: must be none")
        if not text:
            return self
        if unit is None or unit.si_suffix != expected.si_suffix:
            return self._replace(problem=f"unit {text}: must be {symbols(expected.si_suffix)}")
        if self.factor not in (None, unit.factor):
            return self._replace(problem=f"unit {text}: the head states another one")
        return self._replace(factor=unit.factor)

    def check(self, path: Path) -> None:
        """Refuse a unit that does not fit or is not stated."""
        unit = split_key(self.name)[1]
        problem = self.problem
        if self.factor is None and unit is not None:
            problem = problem or f"states no unit: must be {symbols(unit.si_suffix)}"
        if problem:
            raise ParameterError(f"{path}: {self.cell}: {problem}, as in {self.name}")


@dataclass(frozen=True)
class Head:
    """Head of a file, as a layout reads it.

    Attributes
    ----------
    layout : layout of the columns
    separator : character between cells
    row : number of the head among the lines, from 0
    cells : cells of the head
    """

    layout: Layout
    separator: str
    row: int
    cells: list[str]

    @cached_property
    def columns(self) -> list[Column]:
        """Columns of the layout among the cells."""
        columns = (_column(n, cell, self.layout) for n, cell in enumerate(self.cells) if cell)
        return [column for column in columns if column is not None]

    @cached_property
    def missing(self) -> list[str]:
        """Columns that no cell names."""
        names = {column.name for column in self.columns}
        return [name for name in self.layout.needed if name not in names]

    @cached_property
    def unknown(self) -> list[str]:
        """Cells that name no column."""
        taken = {column.number for column in self.columns}
        return [cell for number, cell in enumerate(self.cells) if cell and number not in taken]

    @property
    def fit(self) -> tuple[int, int, int, int]:
        """Measure by which a head is found: columns, line, what is unknown, units that differ."""
        fitting = len(self.columns) - len(self.missing)
        unknown = -len(self.unknown) if self.columns else len(self.cells)
        return fitting, -self.row, unknown, -sum(bool(column.problem) for column in self.columns)

    @property
    def numeric(self) -> list[Column]:
        """Columns of numbers."""
        return [column for column in self.columns if not self.layout.is_text(column.name)]


def find_head(lines: Lines, layouts: Sequence[Layout]) -> Head:
    """Find the line that names most of the columns of a layout, with the separator of its cells.

    Parameters
    ----------
    lines : lines of the file
    layouts : that it may have

    Raises
    ------
    ParameterError
        A column is missing, unknown or there twice.
    """
    first = lines.texts[:HEAD_LINES]
    present = [sign for sign in lines.separators if any(sign in line for line in first)]
    heads: list[Head] = []
    refusal: ParameterError | None = None
    for separator in present or lines.separators[:1]:
        try:
            rows = lines.rows(separator, HEAD_LINES)
        except ParameterError as error:  # a quote ends before another separator
            refusal = error
            continue
        for row, names in enumerate(rows):
            heads += [Head(layout, separator, row, names) for layout in layouts]
            if any(not head.missing and not head.unknown for head in heads[-len(layouts) :]):
                break
    if not heads:
        raise refusal or ParameterError(f"{lines.path}: is empty")
    best = max(heads, key=lambda head: head.fit)
    _check_names(lines.path, best, layouts)
    return best


def _check_names(path: Path, head: Head, layouts: Sequence[Layout]) -> None:
    names = [column.name for column in head.columns]
    twice = [column.cell for column in head.columns if names.count(column.name) > 1]
    others = [Head(each, head.separator, head.row, head.cells).missing for each in layouts]
    missing = [", ".join(each) for each in others if len(each) == len(head.missing) > 0]
    problems = [f"column {' and '.join(twice)} is there twice"] if twice else []
    problems += [f"{head.unknown[0]}: unknown column"] if head.unknown else []
    verb = "is" if len(head.missing) == 1 else "are"
    problems += [f"{' or '.join(dict.fromkeys(missing))} {verb} missing"] if missing else []
    if problems:
        cells = ", ".join([cell for cell in head.cells if cell][:LISTED])
        free = ", ".join(n for n in head.layout.names if n not in (*names, *head.missing))
        problems += [f"may have {free}"] if head.unknown and free else []
        raise ParameterError(f"{path}: {'; '.join(problems)}; columns found: {cells}")


def with_units(head: Head, row: Sequence[str]) -> list[Column] | None:
    """Columns of numbers with the units that a line below the head states; none if it has numbers.

    Parameters
    ----------
    head : head of the file
    row : cells of the line
    """
    cells = [
        row[column.number].strip("[]() ") if column.number < len(row) else ""
        for column in head.numeric
    ]
    stated = [cell for cell in cells if cell not in NO_UNIT]
    unknown = [cell for cell in stated if find_unit(cell) is None]
    may_be_units = any(column.factor is None for column in head.numeric)
    if not stated or (unknown and (not may_be_units or re.search(r"\d", "".join(unknown)))):
        return None
    return [column.with_unit(cell) for column, cell in zip(head.numeric, cells, strict=True)]


def _column(number: int, cell: str, layout: Layout) -> Column | None:
    """Column that a cell of a head names; none where the layout has no such column."""
    words, unit = split_head(fused(cell), lambda _: True)
    key = re.sub(r"[\s_.-]+", "_", words.strip().lower()).strip("_")
    if unit is not None:
        return _with_bracket(number, cell, _named(key, layout), unit)
    key = f"{key[:-3]}_n_m" if key.endswith("_nm") else key  # as in keys of studies
    name, factor = si_key(key)
    stem, suffix = split_key(key)
    if name in layout.names and (suffix is None or _is_suffix(cell, suffix)):
        return Column(number, cell, name, factor)
    if _named(key, layout):
        return _with_bracket(number, cell, _named(key, layout), "")
    stem = stem if suffix else key.rpartition("_")[0]
    if stem in (split_key(name)[0] for name in layout.names):
        return _with_bracket(number, cell, _named(stem, layout), cell.strip()[len(stem) + 1 :])
    return None


def _with_bracket(number: int, cell: str, name: str, unit: str) -> Column | None:
    if not name:
        return None
    factor = 1.0 if split_key(name)[1] is None else None
    return Column(number, cell, name, factor).with_unit(unit)


def _named(key: str, layout: Layout) -> str:
    """SI name of the column of a key without unit, or of the last words of one column's key."""
    stems = {name: split_key(name)[0] for name in layout.names}
    equal = [name for name, stem in stems.items() if stem == key]
    names = equal or [name for name, stem in stems.items() if stem.endswith(f"_{key}")]
    return names[0] if len(names) == 1 else ""


def _is_suffix(cell: str, unit: Unit) -> bool:
    """Whether a key ends with a suffix in small letters, or with a symbol: `P_mPa` has neither."""
    end = cell.strip()[-len(unit.suffix) :]
    return end == end.lower() or plain_unit(end) == plain_unit(unit.symbol)
