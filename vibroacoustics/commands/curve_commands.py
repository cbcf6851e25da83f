"""Command for a machine's inner curves. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import Annotated, Final

from .command import command
from .options import Option, Plugins, load_plugins
from .outcome import Outcome

CURVES_NAME: Final = "curves.nc"


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
) -> Outcome:
    """Show what goes on inside a machine: curves.nc, a table and a picture of each curve."""
    from .. import report
    from ..report.charts.picture import picture
    from ..sources.curves import curves
    from ..study.loading import load_study_or_machine
    from . import outputs

    load_plugins(plugin)
    folder = out or Path("reports") / file.stem / "curves"
    study_or_machine = load_study_or_machine(file)
    outputs.check_folder(folder)
    inner = curves(study_or_machine, speed, option)
    tables = {f"{name}.csv": report.curve_csv(inner, str(name)) for name in inner.data_vars}
    pictures = map(picture, report.curve_charts(inner))
    written = outputs.write_analysis(inner, folder, CURVES_NAME, tables, pictures)
    lines = [
        f"{name}: {curve.attrs['title']} ({curve.attrs['source']})" for name, curve in inner.items()
    ]
    return Outcome("\n".join(lines), {"curves": written})
