"""Published values of a study, from CSV files."""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.regular_file import read_text
from .evidence import Evidence
from .reader import Reader
from .toml_files import beside

MAXIMUM_BYTES: Final = 1_000_000


def take_evidence(content: dict[str, Any], reader: Reader) -> dict[str, Any]:
    """Take the table `evidence` out of a study: names of CSV files become their rows.

    Raises
    ------
    ParameterError
        It is no table of file names, or a file cannot be read.
    """
    table = content.pop("evidence", {})
    if not isinstance(table, Mapping):
        raise ParameterError(f"{reader.path}: evidence = {table!r}: must be a table")
    rows: dict[str, Any] = {}
    for key, name in table.items():
        file = reader.file(("evidence", key))
        if key not in Evidence.model_fields:
            allowed = ", ".join(Evidence.model_fields)
            raise ParameterError(f"{file}: evidence.{key}: unknown key; allowed {allowed}")
        if not isinstance(name, str):
            raise ParameterError(f"{file}: evidence.{key} = {name!r}: must be a file name")
        rows[key] = _rows(beside(file, name))
    return rows


def _rows(path: Path) -> tuple[dict[str, Any], ...]:
    """Rows of a CSV file with a head; lines that begin with # do not count."""
    _, lines = _remarks_and_rows(path)
    table = csv.DictReader(lines)
    return tuple({key: _number_or_text(cell) for key, cell in row.items()} for row in table)


def _remarks_and_rows(path: Path) -> tuple[list[str], list[str]]:
    try:
        lines = read_text(path, MAXIMUM_BYTES).splitlines()
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:  # no UTF-8, no file name
        raise ParameterError(f"{path}: cannot be read: {error}") from None
    remarks = [line for line in lines if line.startswith("#")]
    return remarks, [line for line in lines if line.strip() and not line.startswith("#")]


def _number_or_text(cell: Any) -> Any:
    try:
        return float(cell)
    except (TypeError, ValueError):
        return cell


def read_published_table(path: Path) -> dict[str, Any]:
    """A published table of scores: `criterion,OPTION,…`, one line a criterion, last the sums."""
    remarks, lines = _remarks_and_rows(path)
    rows = list(csv.reader(lines))
    try:
        options = tuple(rows[0][1:])
        numbers = [tuple(float(cell) for cell in row[1:]) for row in rows[1:]]
        if len(rows) < 3 or any(len(row) != len(options) for row in numbers):
            raise ValueError("rows of different length")
    except (ValueError, IndexError) as error:
        raise ParameterError(f"{path}: is no table of scores: {error}") from None
    return {
        "source": " ".join(line.lstrip("# ") for line in remarks),
        "options": options,
        "criteria": tuple(row[0] for row in rows[1:-1]),
        "scores": tuple(zip(*numbers[:-1], strict=True)),
        "sums": numbers[-1],
    }
