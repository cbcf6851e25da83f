"""Command for a machine's inner curves. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import Annotated

from .command import command
from .options import Option, Plugins, Printing, load_plugins
from .outcome import Outcome


@command("curves", "Studies", "pipelines/copeland_sources.toml --speed 2900")
def curves_command(
    file: Annotated[Path, "FILE: Study or machine file, .toml."],
    speed: Annotated[
        float | None,
        "Shaft speed, rpm; default: the study's first, or of the overall noise.",
    ] = None,
    option: Option = "none",
    out: Annotated[Path | None, "Folder; default: reports/NAME OF THE FILE/curves."] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Show what goes on inside a machine: curves.nc, a table and a picture of each curve."""
    from .. import report
    from ..sources.curves import curves
    from ..study.loading import load_study_or_machine
    from . import outputs

    load_plugins(plugin)
    folder = out or Path("reports") / file.stem / "curves"
    study_or_machine = load_study_or_machine(file)
    outputs.check_folder(folder)
    prints = printing.printer()
    inner = curves(study_or_machine, speed, option)
    analysis = report.analysis_of_curves(inner)
    files = outputs.write_analysis(analysis, inner, folder, "curves.nc", prints)
    return Outcome(files=files, analyses={"": analysis})
