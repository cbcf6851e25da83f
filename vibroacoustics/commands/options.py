"""Options that several commands share."""

from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Annotated

StudyFile = Annotated[Path, "STUDY: Study file, .toml."]
ResultsFile = Annotated[Path, "RESULTS: Results of a run, results.nc."]
Recording = Annotated[Path, "RECORDING: File of the recording."]
FileOut = Annotated[Path | None, "Folder of the results; default: reports/NAME OF THE FILE."]
StudyOut = Annotated[Path | None, "Folder of the results; default: reports/NAME OF THE STUDY."]
Speed = Annotated[float | None, "Shaft speed, rpm; default: the first."]
Option = Annotated[str, "Balancing option of the study."]
Plugins = Annotated[
    list[Path] | None,
    "Python file, .py, with options, sources, machines, readers, … of yours; it is run.",
]
LimitsFile = Annotated[
    Path | None,
    "CSV file of limits: channel,order,limit,unit; `compare` takes those of bands, "
    "totals and criteria, too. The exit code is 1 where a limit is broken.",
]
NoCache = Annotated[bool, "Neither read nor write the cache of the radiation."]
Pdf = Annotated[
    bool,
    "Print the page as PDF, too; needs Chromium, Chrome or Edge on PATH.",
]
Paper = Annotated[str | None, "Sheets of the PDF: a4 or letter; default: a4."]


def used_cache(unused: bool) -> AbstractContextManager[None]:
    """The use of the cache that is asked for."""
    from ..results import storage

    return storage.without_cache() if unused else nullcontext()


def load_plugins(plugins: list[Path] | None) -> None:
    """Take in the files that the user names."""
    from ..base.plugin_file import load_plugin

    for file in plugins or ():
        load_plugin(file)


def with_pdf(files: dict[str, Path], page: Path, printed: object) -> dict[str, Path]:
    """Return the files by label, with the PDF of a page where it was printed."""
    return files if printed is None else {**files, "pdf": page.with_suffix(".pdf")}
