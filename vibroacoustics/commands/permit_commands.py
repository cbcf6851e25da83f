"""Command that judges units by the rules of authorities. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

from .command import command
from .options import FileOut, Plugins, Printing, load_plugins
from .outcome import Outcome


@command("permit", "Studies", "heat_pump/permit.toml")
def permit_command(
    file: Annotated[Path, "FILE: File of units and windows, .toml; `new permit` writes one."],
    out: FileOut = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Judge units at windows by rules of authorities: level, spare, least distance, probability."""
    from ..permits.file import load_permit
    from .permits.page import analysis_of_permit

    load_plugins(plugin)
    target = printing.target(out or Path("reports") / file.stem)
    return target.outcome(analysis_of_permit(load_permit(file)))
