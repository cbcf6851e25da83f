"""Columns of numbers with their unit in the name, from a CSV file of the user."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from .arrays import Array
from .errors import ParameterError
from .regular_file import read_text
from .units import si_key, split_key

MAXIMUM_BYTES: Final = 200_000_000


@dataclass(frozen=True)
class Columns:
    """What a file's columns hold.

    Attributes
    ----------
    path : of the file
    numbers : in SI by SI name, shape (row,)
    texts : of the columns of words
    lines : number of each row's line
    """

    path: Path
    numbers: dict[str, Array]
    texts: dict[str, tuple[str, ...]]
    lines: tuple[int, ...]

    def refusal(self, row: int, words: str) -> ParameterError:
        """What to raise of a row."""
        return ParameterError(f"{self.path}: line {self.lines[row]}: {words}")


def column_names(path: Path) -> tuple[str, ...]:
    """SI names of a file's columns, for a file that may be of several layouts; errors as below."""
    return tuple(si_key(_plain(cell))[0] for cell in _rows(path)[1][0])


def read_columns(
    path: str | Path,
    numbers: Sequence[str],
    optional: Sequence[str] = (),
    texts: Sequence[str] = (),
) -> Columns:
    """Read columns of a CSV file by their SI names; lines that begin with # are remarks.

    A column may be in any unit of its quantity, as its name says: `fx_n`, `speed_rpm`.

    Parameters
    ----------
    path : file with a head line, separated by commas
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
    path = Path(path)
    lines, rows = _rows(path)
    head = [_plain(cell) for cell in rows[0]]
    fields = {si_key(name)[0]: at for at, name in enumerate(head)}
    if len(fields) < len(head):
        raise ParameterError(f"{path}: a column is given twice: {', '.join(head)}")
    _check_names(path, head, fields, numbers, (*numbers, *optional, *texts))
    for line, row in zip(lines[1:], rows[1:], strict=True):
        if len(row) != len(head):
            raise ParameterError(f"{path}: line {line}: {len(row)} cells, the head has {len(head)}")
    cells = list(zip(*rows[1:], strict=True))
    if not cells:
        raise ParameterError(f"{path}: has no rows under its head")
    return Columns(
        path,
        {
            name: si_key(head[at])[1] * _numbers(path, head[at], cells[at], lines[1:])
            for name, at in fields.items()
            if name not in texts
        },
        {
            name: tuple(cell.strip() for cell in cells[at])
            for name, at in fields.items()
            if name in texts
        },
        tuple(lines[1:]),
    )


def _rows(path: Path) -> tuple[list[int], list[list[str]]]:
    try:
        text = read_text(path, MAXIMUM_BYTES)
    except FileNotFoundError:
        raise ParameterError(f"{path}: no such file") from None
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError:
        raise ParameterError(f"{path}: is not UTF-8 text") from None
    kept = [
        (number, line)
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip(" ,;") and not line.startswith("#")
    ]
    if not kept:
        raise ParameterError(f"{path}: is empty")
    try:
        rows = list(csv.reader((line for _, line in kept), strict=True))
    except csv.Error as error:
        raise ParameterError(f"{path}: is not a CSV file: {error}") from None
    if len(rows) != len(kept):
        raise ParameterError(f"{path}: a cell has a line break")
    return [number for number, _ in kept], rows


def _plain(cell: str) -> str:
    """A column's name with the newton metre as in keys, `mx_nm` is `mx_n_m`."""
    name = cell.strip()
    return f"{name[:-3]}_n_m" if name.endswith("_nm") else name


def _check_names(
    path: Path,
    head: Sequence[str],
    fields: dict[str, int],
    needed: Sequence[str],
    known: Sequence[str],
) -> None:
    """Refuse what lacks, what is in a wrong unit and what is unknown, the first of them."""
    stems = {split_key(name)[0]: name for name in known}
    for name, at in fields.items():
        if name in known:
            continue
        meant = stems.get(split_key(head[at])[0]) or stems.get(head[at].rpartition("_")[0])
        others = f"unknown column; columns are {', '.join(known)}"
        words = f"wrong unit, needs {meant} or another unit of it" if meant else others
        raise ParameterError(f"{path}: {head[at]}: {words}")
    for name in needed:
        if name not in fields:
            raise ParameterError(f"{path}: column {name} is missing")


def _numbers(path: Path, name: str, cells: Sequence[str], lines: Sequence[int]) -> Array:
    try:
        values = np.array(cells, dtype=np.float64)
        if np.all(np.isfinite(values)):
            return values
    except ValueError:
        pass
    for line, cell in zip(lines, cells, strict=True):
        if not _is_finite(cell):
            shown = cell.strip() or "nothing"
            raise ParameterError(f"{path}: line {line}: {name} = {shown}: must be a finite number")
    raise ParameterError(f"{path}: {name}: must be finite numbers")


def _is_finite(cell: str) -> bool:
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return False
