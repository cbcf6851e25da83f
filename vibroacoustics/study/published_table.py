"""A published table of scores, from a CSV file."""

import csv
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.regular_file import read_text

MAXIMUM_BYTES: Final = 1_000_000


def read_published_table(path: Path) -> dict[str, Any]:
    """A published table of scores: `criterion,OPTION,…`, one line a criterion, last the sums."""
    try:
        lines = read_text(path, MAXIMUM_BYTES).splitlines()
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:  # no UTF-8, no file name
        raise ParameterError(f"{path}: cannot be read: {error}") from None
    source = " ".join(line.lstrip("# ") for line in lines if line.startswith("#"))
    rows = list(csv.reader(line for line in lines if line.strip() and not line.startswith("#")))
    try:
        options = tuple(rows[0][1:])
        numbers = [tuple(float(cell) for cell in row[1:]) for row in rows[1:]]
        if len(rows) < 3 or any(len(row) != len(options) for row in numbers):
            raise ValueError("rows of different length")
    except (ValueError, IndexError) as error:
        raise ParameterError(f"{path}: is no table of scores: {error}") from None
    return {
        "source": source,
        "options": options,
        "criteria": tuple(row[0] for row in rows[1:-1]),
        "scores": tuple(zip(*numbers[:-1], strict=True)),
        "sums": numbers[-1],
    }
