"""Files of a run on disk: the dataset, the report, its tables and figures."""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import xarray as xr

from .. import report
from ..base.errors import ParameterError, SchemaError, StorageError
from ..base.folder import Content, Folder, opened_folder
from ..report.analysis import Analysis
from ..report.blocks import Bullets, Part
from ..results import manifest, storage
from ..results.complete import check_run
from ..results.files import LOCK_NAME, STAGING_NAME, write, write_together
from ..results.files import naming as writing
from ..results.run_variables import check_known
from .outcome import Outcome
from .printing import Printer

if TYPE_CHECKING:
    from ..results.data_sheet import DataSheet

RESULTS_NAME: Final = "results.nc"
REPORT_NAME: Final = "report.html"
REPORT_FILES: Final = (
    REPORT_NAME,
    "report.pdf",
    "comparison.md",
    *(
        f"{table}.csv"
        for table in (
            "alternatives",
            "claims",
            "comparison",
            "conflict",
            "evidence",
            "feet",
            "figures",
            "inputs",
            "measured_spectrum",
            "path_bands",
            "path_motions",
            "path_orders",
            "paths",
            "provenance",
            "rating",
            "report_conditions",
            "room",
            "scores",
            "scoring",
            "sources",
            "speeds",
            "stopping",
            "structure_borne",
            "tones",
            "uncertainty",
            "vibration",
        )
    ),
    "figures/*.png",
    "figures/*.svg",
)
"""Files of a report."""
_LONGEST_NAME: Final = 255
_LONGEST_PATH: Final = 3500
"""Bytes of a folder's path: Linux takes 4096 with a file's name."""
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
    """Results of a run or of the analysis of a recording, of this version of the vocabulary."""
    results, _ = _open_of_this_version(path)
    return results if "channel_order" in results else open_run(path)[0]


def _open_of_this_version(path: str | Path) -> tuple[xr.Dataset, str]:
    results, digest = storage.open_with_hash(path)
    storage.check_version(results, path)
    try:
        check_known(results)
    except SchemaError as error:
        raise StorageError(f"{path}: {error}; make it again") from None
    return results, digest


def check_folder(folder: str | Path, files: Iterable[str] = ()) -> None:
    """Refuse a folder that cannot be written, before anything is computed.


    Raises
    ------
    StorageError
        It lies under a file or in a folder without write permission, a name of a file is that of a
        link, pipe, socket or device, or the folder's name is too long or no UTF-8, which netCDF
        cannot write.
    """
    try:
        str(folder).encode()
    except UnicodeEncodeError:
        raise StorageError(f"{str(folder)!a}: cannot be written: the name is no UTF-8") from None
    longest = max((len(os.fsencode(part)) for part in Path(folder).parts), default=0)
    if longest > _LONGEST_NAME or len(os.fsencode(Path(folder).absolute())) > _LONGEST_PATH:
        raise StorageError(f"{folder}: cannot be written: the name is too long")
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
    return write_study(results, folder)[1]["report"]


def write_data_sheet(sheet: "DataSheet", folder: str | Path) -> Path:
    """Write page, CSV and JSON of a data sheet, together or not at all.

    Option and speed stand in their names: sheets of several fit one folder.

    Parameters
    ----------
    sheet : result of `data_sheet`
    folder : made where it is missing

    Returns
    -------
    path of the page

    Raises
    ------
    StorageError
        The folder cannot be written; what was there before then stays.

    Examples
    --------
    >>> sheet = va.data_sheet(va.open_results("results.nc"), "none")
    >>> va.write_data_sheet(sheet, "sheets").name
    'data_sheet_none_2900_rpm.html'
    """
    return write_analysis(report.analysis_of_data_sheet(sheet), None, folder)["report"]


def write_study(
    results: xr.Dataset, folder: str | Path, printer: Printer | None = None
) -> tuple[Analysis, dict[str, Path]]:
    """Write the dataset of a run with its report; see `write_report` and `write_analysis`."""
    kept = report.keep(results)
    analysis = report.analysis_of_study(kept)
    return analysis, write_analysis(analysis, kept, folder, RESULTS_NAME, printer)


def write_report_again(
    results_file: Path, folder: Path, printer: Printer | None = None
) -> tuple[Analysis, dict[str, Path]]:
    """Write the report of results that are on disk, its tables and figures, together or not at all.

    Returns
    -------
    the report, and paths of page and PDF by what they are
    """
    results, digest = open_run(results_file)
    analysis = report.analysis_of_study(results)
    files = _files(analysis, digest, printer)
    with manifest.replacing(folder, results_file.name, digest) as staged:
        _stage(files, staged)
    return analysis, written_files(analysis, folder, printer=printer)


def older_files(folder: Path) -> list[str]:
    """Files of a report that are of another run or of nobody knows which, a line each."""
    mixed, listed = manifest.mixed(folder), manifest.listed(folder)
    present = {p.relative_to(folder).as_posix() for name in REPORT_FILES for p in folder.glob(name)}
    named = {line.partition(": ")[0] for line in mixed}
    strange = [path for name in sorted(present - listed) if str(path := folder / name) not in named]
    return [*mixed, *(f"{path}: is not of these results" for path in strange)]


def write_analysis(
    analysis: Analysis,
    dataset: xr.Dataset | None,
    folder: str | Path,
    dataset_name: str = "",
    printer: Printer | None = None,
) -> dict[str, Path]:
    """Write an analysis with its dataset, where there is one, together or not at all.


    Returns
    -------
    paths of dataset, page and PDF, by what they are
    """
    folder = Path(folder)
    paths = written_files(analysis, folder, dataset_name, printer)
    if dataset is None:
        files = _files(analysis, "", printer)
        write_together(folder, files)
        others = {name: folder / name for name in files}
        return paths | {name: path for name, path in others.items() if path not in paths.values()}
    with manifest.replacing(folder, dataset_name) as staged:
        digest = storage.stage_results(dataset, staged, dataset_name)
        _stage(_files(analysis, digest, printer), staged)
    return paths


class Target(NamedTuple):
    """Target of the results of a command: their folder, and what makes a PDF of the page."""

    folder: Path
    printer: Printer | None

    def outcome(
        self,
        analysis: Analysis,
        dataset: xr.Dataset | None = None,
        dataset_name: str = "",
        broken: Sequence[str] = (),
    ) -> Outcome:
        """Write an analysis with its dataset; the outcome names the files and broken limits."""
        analysis = _with_remarks(analysis, {} if dataset is None else dataset.attrs)
        files = write_analysis(analysis, dataset, self.folder, dataset_name, self.printer)
        return Outcome(files=files, analyses={"": analysis}, broken=broken)


def _with_remarks(analysis: Analysis, attributes: Mapping[str, Any]) -> Analysis:
    """Analysis with the warnings that the reading of its recording gave, where there are some."""
    remarks = str(attributes.get("reading_remarks", ""))
    if not remarks:
        return analysis
    part = Part("warnings", "Warnings", (Bullets(tuple(remarks.split("; "))),))
    return replace(analysis, parts=(*analysis.parts, part))


def written_files(
    analysis: Analysis, folder: Path, dataset_name: str = "", printer: Printer | None = None
) -> dict[str, Path]:
    """Return paths of dataset, page and PDF of an analysis by what they are."""
    page = folder / analysis.page
    return {
        **({"results": folder / dataset_name} if dataset_name else {}),
        "report": page,
        **({"pdf": page.with_suffix(".pdf")} if printer else {}),
    }


def _files(analysis: Analysis, digest: str, printer: Printer | None) -> dict[str, Content]:
    files = analysis.files(digest)
    return {**files, **(printer.pages(files) if printer else {})}


def _stage(files: Mapping[str, Content], staged: Folder) -> None:
    for name, content in files.items():
        write(staged, name, content)
