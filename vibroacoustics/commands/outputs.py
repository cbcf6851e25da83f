"""What a run leaves on disk: the dataset, the report, its tables and figures."""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import xarray as xr

from .. import report
from ..base.errors import ParameterError, SchemaError, StorageError
from ..base.folder import Folder, opened_folder
from ..report.charts.picture import Picture, picture
from ..results import manifest, storage
from ..results.complete import check_run
from ..results.figure_limits import CheckedFigure, Compared
from ..results.files import LOCK_NAME, STAGING_NAME, write
from ..results.files import naming as writing
from ..results.provenance import RECORDING_SCHEMA_VERSION, SCHEMA_VERSION
from .printing import Printer

RESULTS_NAME: Final = "results.nc"
REPORT_NAME: Final = "report.html"
TRANSFER_VECTORS_NAME: Final = "transfer_vectors.nc"
ORDERS_NAME: Final = "orders.nc"
ORDERS_REPORT_NAME: Final = "orders.html"
COMPARISON_NAME: Final = "compared_orders.nc"
LIMITS_NAME: Final = "orders_limits.csv"
COMPARED_LIMITS_NAME: Final = "compared_orders_limits.csv"
COMPARED_FIGURES_NAME: Final = "compared_figures_limits.csv"
COMPARISON_REPORT_NAME: Final = "compared.html"
REPORT_FILES: Final = (
    REPORT_NAME,
    "comparison.csv",
    "comparison.md",
    "scores.csv",
    "sources.csv",
    "paths.csv",
    "speeds.csv",
    "report.pdf",
    "figures/*.png",
    "figures/*.svg",
)
"""What a report may consist of."""
RUN_FILES: Final = (manifest.MANIFEST_NAME, RESULTS_NAME, *REPORT_FILES)


def open_run(path: str | Path) -> tuple[xr.Dataset, str]:
    """Results of a run with their hash, checked to be what a report and a score can be made of.

    Raises
    ------
    StorageError
        The file cannot be read, or holds something else, an incomplete run, or another version
        of the vocabulary.
    """
    results, digest = _open_of_this_version(path)
    if "criterion_value" not in results:
        raise StorageError(f"{path}: holds no run: {results.attrs.get('title', 'other results')}")
    try:
        check_run(results)
        report.check_kept(results)
    except SchemaError as error:
        raise StorageError(f"{path}: holds no complete run: {error}; make it again") from None
    return results, digest


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Put a file before what is wrong with the values that it holds."""
    try:
        yield
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None


def open_orders(path: str | Path) -> xr.Dataset:
    """Results of a run or of the analysis of a recording, of this version of the vocabulary.

    Raises
    ------
    StorageError
        The file cannot be read, or holds another version of the vocabulary.
    """
    return _open_of_this_version(path)[0]


def _open_of_this_version(path: str | Path) -> tuple[xr.Dataset, str]:
    results, digest = storage.open_with_hash(path)
    version = results.attrs.get("schema_version")
    recorded = "channel_order" in results
    allowed = RECORDING_SCHEMA_VERSION if recorded else SCHEMA_VERSION
    if version != allowed:
        again = "orders RECORDING" if recorded else "run STUDY.toml"
        raise StorageError(
            f"{path}: schema_version = {version}: is no result of this version, {allowed}; make it "
            f"again: vibroacoustics {again}"
        )
    return results, digest


def check_folder(folder: str | Path, files: Iterable[str] = ()) -> None:
    """Refuse a folder that cannot be written, before anything is computed.

    Parameters
    ----------
    folder : of the results
    files : names of what will be written in it

    Raises
    ------
    StorageError
        It lies under a file or in a folder without write permission, a name of a file is that of a
        link, pipe, socket or device, or the folder's name is no UTF-8, which netCDF cannot write.
    """
    try:
        str(folder).encode()
    except UnicodeEncodeError:
        raise StorageError(f"{str(folder)!a}: cannot be written: the name is no UTF-8") from None
    existing = Path(folder).absolute()
    while not os.path.lexists(existing):
        existing = existing.parent
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise StorageError(f"{folder}: cannot be written: {existing} is no writable folder")
    if existing == Path(folder).absolute():
        with writing(Path(folder)), opened_folder(existing) as present:
            present.check_folder(STAGING_NAME)
            for name in (LOCK_NAME, *files):
                present.check_file(name)


def write_report(results: xr.Dataset, folder: str | Path) -> Path:
    """Write the dataset of a run with its report, tables and figures, together or not at all.

    The dataset holds what sections and columns of plug-ins show, so that the report can be made
    again without them.

    Parameters
    ----------
    results : dataset of a finished run
    folder : made where it is missing

    Returns
    -------
    path of the report

    Raises
    ------
    StorageError
        The folder cannot be written; what was there before then stays.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.write_report(results, "written").name
    'report.html'
    """
    kept = report.keep(results)
    with manifest.replacing(Path(folder), RESULTS_NAME) as staged:
        digest = storage.stage_results(kept, staged, RESULTS_NAME)
        _stage(report.render(kept, digest), staged)
    return Path(folder) / REPORT_NAME


def write_report_again(results_file: Path, folder: Path, printer: Printer | None = None) -> Path:
    """Write the report of results that are on disk, its tables and figures, together or not at all.

    Returns
    -------
    path of the report
    """
    results, digest = open_run(results_file)
    files = with_pdf(report.render(results, digest), printer)
    with manifest.replacing(folder, results_file.name, digest) as staged:
        _stage(files, staged)
    return folder / REPORT_NAME


def with_pdf(files: Mapping[str, bytes], printer: Printer | None) -> dict[str, bytes]:
    """The files, and those that a printer makes of their pages."""
    return {**files, **(printer.pages(files) if printer else {})}


def older_files(folder: Path) -> list[str]:
    """Files of a report that are of another run or of nobody knows which, a line each."""
    mixed, known = manifest.mixed(folder), manifest.listed(folder)
    present = {p.relative_to(folder).as_posix() for name in REPORT_FILES for p in folder.glob(name)}
    named = {line.partition(": ")[0] for line in mixed}
    strange = [path for name in sorted(present - known) if str(path := folder / name) not in named]
    return [*mixed, *(f"{path}: is not of these results" for path in strange)]


def write_radiation(radiated: xr.Dataset, folder: str | Path) -> Path:
    """Write transfer vectors and their figures, together or not at all.

    Returns
    -------
    path of the dataset
    """
    pictures = report.radiation_figures(radiated)
    return write_analysis(radiated, folder, TRANSFER_VECTORS_NAME, {}, pictures)


def write_orders(results: xr.Dataset, folder: str | Path, printer: Printer | None = None) -> Path:
    """Write the orders of a recording with page, tables and figures; see `write_radiation`."""
    tables = {"orders.csv": report.orders_csv(results)}
    if "equivalent_level" in results:
        tables["levels.csv"] = report.levels_csv(results)
    if "order_limit" in results:
        tables[LIMITS_NAME] = report.limits_csv(results)
    charts = report.recorded_order_charts(results)
    tables[ORDERS_REPORT_NAME] = report.orders_html(results, charts)
    tables = with_pdf(tables, printer)
    return write_analysis(results, folder, ORDERS_NAME, tables, map(picture, charts))


def write_comparison(
    compared: Compared,
    figures: Sequence[CheckedFigure],
    folder: str | Path,
    printer: Printer | None = None,
) -> Path:
    """Write compared orders with their page, tables and figures; see `write_radiation`."""
    orders = compared.orders
    tables = {"compared_orders.csv": report.comparison_of_orders_csv(orders)}
    if "order_limit" in orders:
        tables[COMPARED_LIMITS_NAME] = report.limits_csv(orders)
    if figures:
        tables[COMPARED_FIGURES_NAME] = report.figure_limits_csv(figures)
    charts = report.compared_order_charts(orders)
    tables[COMPARISON_REPORT_NAME] = report.comparison_html(compared, figures, charts)
    tables = with_pdf(tables, printer)
    return write_analysis(orders, folder, COMPARISON_NAME, tables, map(picture, charts))


def write_analysis(
    results: xr.Dataset,
    folder: str | Path,
    name: str,
    tables: Mapping[str, bytes],
    pictures: Iterable[Picture] = (),
) -> Path:
    """Write a dataset with tables and what was drawn of it, together or not at all.

    Returns
    -------
    path of the dataset
    """
    drawn = {f"{each.name}.{each.ending}": each.content for each in pictures}
    with manifest.replacing(Path(folder), name) as staged:
        storage.stage_results(results, staged, name)
        _stage({**tables, **drawn}, staged)
    return Path(folder) / name


def _stage(files: Mapping[str, bytes], staged: Folder) -> None:
    for name, content in files.items():
        write(staged, name, content)
