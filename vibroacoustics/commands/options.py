"""Options that several commands share."""

from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer


def out_option(words: str) -> Any:
    """Return the option `--out` with its help."""
    return typer.Option("--out", help=words)


ResultsFile = Annotated[Path, typer.Argument(metavar="RESULTS.nc", help="Results of a run.")]
FileOut = Annotated[
    Path | None, out_option("Folder of the results; default: reports/NAME OF THE FILE.")
]
StudyOut = Annotated[
    Path | None, out_option("Folder of the results; default: reports/NAME OF THE STUDY.")
]
Plugins = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin",
        metavar="FILE.py",
        help="Python file with options, sources, machines, readers, … of yours; it is run.",
    ),
]
LimitsFile = Annotated[
    Path | None,
    typer.Option(
        "--limits",
        metavar="LIMITS.csv",
        help="Hold the orders against these limits: channel,order,limit,unit. "
        "The exit code is 0 where they are exceeded, too.",
    ),
]

NoCache = Annotated[
    bool, typer.Option("--no-cache", help="Neither read nor write the cache of the radiation.")
]


Pdf = Annotated[
    bool,
    typer.Option(
        "--pdf", help="Print the page as PDF, too; needs Chromium, Chrome or Edge on PATH."
    ),
]
Paper = Annotated[
    str | None, typer.Option(metavar="SIZE", help="Of the PDF: a4 or letter; default: a4.")
]


def used_cache(unused: bool) -> AbstractContextManager[None]:
    """The use of the cache that is asked for."""
    from ..results import storage

    return storage.without_cache() if unused else nullcontext()


def load_plugins(plugins: list[Path] | None) -> None:
    """Take in the files that the user names."""
    from ..base.plugin_file import load_plugin

    for file in plugins or ():
        load_plugin(file)
