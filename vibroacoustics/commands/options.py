"""Options that several commands share."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

if TYPE_CHECKING:
    from ..study.study import Study
    from .outputs import Target
    from .printing import Printer

Result = TypeVar("Result")
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


@dataclass(frozen=True)
class Printing:
    """Options of a page on paper.

    Attributes
    ----------
    pdf : whether it is printed
    paper : size of the sheets
    brief : whether what is folded is omitted
    """

    pdf: Annotated[bool, "Print the page as PDF, too; needs Chromium, Chrome or Edge on PATH."] = (
        False
    )
    paper: Annotated[str | None, "Sheets of the PDF: a4 or letter; default: a4."] = None
    brief: Annotated[bool, "Omit what is folded from the PDF."] = False

    def printer(self) -> "Printer | None":
        """Find what prints; None where no PDF is wanted."""
        from .printing import printer

        return printer(self.pdf, self.paper, self.brief)

    def target(self, folder: Path) -> "Target":
        """Return the folder of the results, which can be written, with what prints."""
        from . import outputs

        outputs.check_folder(folder)
        return outputs.Target(folder, self.printer())


def used_cache(unused: bool) -> AbstractContextManager[None]:
    """The use of the cache that is asked for."""
    from ..results import storage

    return storage.without_cache() if unused else nullcontext()


def resumed(job: str, study: "Study", unused: bool, work: Callable[[], Result]) -> Result:
    """Do work that continues an interrupted run of the same inputs, unless its store is unused."""
    from ..results import run_pieces
    from . import messages

    if unused:
        return work()
    return run_pieces.resumed(job, study.parameters(), messages.inform, work)


def load_plugins(plugins: list[Path] | None) -> None:
    """Take in the files that the user names."""
    from ..base.plugin_file import load_plugin

    for file in plugins or ():
        load_plugin(file)
