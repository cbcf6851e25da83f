"""What a run leaves on disk: the dataset, the report, its tables and figures."""

from pathlib import Path
from typing import Final

import xarray as xr

from . import report, storage

RESULTS_NAME: Final = "results.nc"
REPORT_NAME: Final = "report.html"


def write_report(results: xr.Dataset, folder: str | Path) -> Path:
    """Write report, tables and figures, each whole or not at all.

    Everything is rendered before the first file is written, and the report itself comes last.

    Returns
    -------
    path of the report
    """
    files = report.render(results)
    for name in sorted(files, key=lambda name: name == REPORT_NAME):
        storage.write_bytes(Path(folder) / name, files[name])
    return Path(folder) / REPORT_NAME


def write_all(results: xr.Dataset, folder: str | Path) -> Path:
    """Write the dataset and then the report; returns the path of the report."""
    storage.write_results(results, Path(folder) / RESULTS_NAME)
    return write_report(results, folder)
