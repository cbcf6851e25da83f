"""What a run says to other programs."""

import csv
import io
from math import isfinite
from pathlib import Path
from typing import Any, Final

import xarray as xr

from ..base.regular_file import read_text
from ..report.kwave_words import kwave_difference_db, receiver_methods
from ..results.estimates import has_samples, sample_numbers
from ..study.study import Study
from .outputs import REPORT_NAME, RESULTS_NAME

_MAXIMUM_BYTES: Final = 100_000_000
_ROWS: Final = ("comparison", "scores")


def summary(study: Study, results: xr.Dataset, folder: Path, seconds: float) -> dict[str, Any]:
    """A run as plain JSON values: files, time, and the rows of its tables.

    Parameters
    ----------
    study : that was run
    results : of it, already written
    folder : where they are
    seconds : that it took
    """
    return {
        "study": study.source_file,
        "title": study.title,
        "machine": study.machine.name,
        "results": str(folder / RESULTS_NAME),
        "report": str(folder / REPORT_NAME),
        "seconds": round(seconds, 1),
        "samples": sample_numbers(results).computed if has_samples(results) else 0,
        "coarsened": list(study.coarsened),
        "kwave_difference_db": kwave_difference_db(results),
        "receivers": {
            name: {"method": method, "reason": reason}
            for name, (method, reason) in receiver_methods(results).items()
        },
        **{name: _rows(read_text(folder / f"{name}.csv", _MAXIMUM_BYTES)) for name in _ROWS},
    }


def _rows(text: str) -> list[dict[str, Any]]:
    """Rows of a table by head; numbers as numbers, empty cells as null."""
    return [
        {head: _value(cell) for head, cell in row.items()}
        for row in csv.DictReader(io.StringIO(text))
    ]


def _value(cell: str) -> str | float | None:
    try:
        number = float(cell)
    except ValueError:
        return cell or None
    return number if isfinite(number) else None
