"""Options that several commands share."""

from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Annotated

import typer

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
