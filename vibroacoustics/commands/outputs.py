"""What a run leaves on disk: the dataset, the report, its tables and figures."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Final

import xarray as xr

from .. import report
from ..base.errors import StorageError
from ..report.figures import Picture
from ..results import storage
from ..results.provenance import RECORDING_SCHEMA_VERSION, SCHEMA_VERSION

RESULTS_NAME: Final = "results.nc"
REPORT_NAME: Final = "report.html"
TRANSFER_VECTORS_NAME: Final = "transfer_vectors.nc"
ORDERS_NAME: Final = "orders.nc"
COMPARISON_NAME: Final = "compared_orders.nc"
CURVES_NAME: Final = "curves.nc"


def open_run(path: str | Path) -> xr.Dataset:
    """Results of a run, checked to be what a report and a score can be made of.

    Raises
    ------
    StorageError
        The file cannot be read, or holds something else, or another version of the vocabulary.
    """
    results = open_orders(path)
    if "criterion_value" not in results:
        raise StorageError(f"{path}: holds no run: {results.attrs.get('title', 'other results')}")
    return results


def open_orders(path: str | Path) -> xr.Dataset:
    """Results of a run or of the analysis of a recording, of this version of the vocabulary.

    Raises
    ------
    StorageError
        The file cannot be read, or holds another version of the vocabulary.
    """
    results = storage.open_results(path)
    version = results.attrs.get("schema_version")
    recorded = "channel_order" in results
    allowed = RECORDING_SCHEMA_VERSION if recorded else SCHEMA_VERSION
    if version != allowed:
        again = "orders RECORDING" if recorded else "run STUDY.toml"
        raise StorageError(
            f"{path}: schema_version = {version}: is no result of this version, {allowed}; make it "
            f"again: vibroacoustics {again}"
        )
    return results


def check_folder(folder: str | Path) -> None:
    """Refuse a folder that cannot be written, before anything is computed.

    Raises
    ------
    StorageError
        It lies under a file or in a folder without write permission.
    """
    existing = Path(folder).absolute()
    while not existing.exists():
        existing = existing.parent
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise StorageError(f"{folder}: cannot be written: {existing} is no writable folder")


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
    """Write the dataset and then the report; returns the path of the report.

    The dataset holds what sections and columns of plug-ins show, so that the report can be made
    again without them.
    """
    results = report.keep(results)
    storage.write_results(results, Path(folder) / RESULTS_NAME)
    return write_report(results, folder)


def write_radiation(radiated: xr.Dataset, folder: str | Path) -> Path:
    """Write transfer vectors and their figures, each whole or not at all; the dataset last.

    Everything is rendered before the first file is written.

    Returns
    -------
    path of the dataset
    """
    return _write_analysis(radiated, folder, TRANSFER_VECTORS_NAME, {}, report.radiation_figures)


def write_orders(results: xr.Dataset, folder: str | Path) -> Path:
    """Write the orders of a recording with their tables and figures; see `write_radiation`."""
    tables = {"orders.csv": report.orders_csv(results)}
    if "equivalent_level" in results:
        tables["levels.csv"] = report.levels_csv(results)
    return _write_analysis(results, folder, ORDERS_NAME, tables, report.recorded_order_figures)


def write_comparison(compared: xr.Dataset, folder: str | Path) -> Path:
    """Write compared orders with their table and figures; see `write_radiation`."""
    table = {"compared_orders.csv": report.comparison_of_orders_csv(compared)}
    return _write_analysis(compared, folder, COMPARISON_NAME, table, report.compared_order_figures)


def write_curves(curves: xr.Dataset, folder: str | Path) -> Path:
    """Write curves with a table and a picture of each; see `write_radiation`."""
    tables = {f"{name}.csv": report.curve_csv(curves, str(name)) for name in curves.data_vars}
    return _write_analysis(curves, folder, CURVES_NAME, tables, report.curve_figures)


def _write_analysis(
    results: xr.Dataset,
    folder: str | Path,
    name: str,
    tables: dict[str, bytes],
    figures: Callable[[xr.Dataset], list[Picture]],
) -> Path:
    """Write a dataset with what was drawn of it, each whole or not at all; the dataset last."""
    files = tables | {f"{picture.name}.png": picture.png for picture in figures(results)}
    for file, content in files.items():
        storage.write_bytes(Path(folder) / file, content)
    return storage.write_results(results, Path(folder) / name)
