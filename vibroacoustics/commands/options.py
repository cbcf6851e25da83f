"""Options that several commands share."""

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


def load_plugins(plugins: list[Path] | None) -> None:
    """Take in the files that the user names."""
    from ..base.plugin_file import load_plugin

    for file in plugins or ():
        load_plugin(file)
