"""Command for a machine's inner curves. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import Annotated, Final

import typer

from .options import out_option

CURVES_NAME: Final = "curves.nc"

commands = typer.Typer()


@commands.command("curves")
def curves_command(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="A study, or a machine alone.")],
    speed: Annotated[
        float | None,
        typer.Option(help="Mean speed, rpm; default: the study's first, or of the overall noise."),
    ] = None,
    option: Annotated[
        str, typer.Option(help="Balancing option of the study, such as a redesign.")
    ] = "none",
    out: Annotated[
        Path | None, out_option("Folder; default: reports/NAME OF THE FILE/curves.")
    ] = None,
    plugin: Annotated[
        list[Path] | None,
        typer.Option("--plugin", metavar="FILE.py", help="Python file of yours; it is run."),
    ] = None,
) -> None:
    """Show what goes on inside a machine: curves.nc, a table and a picture of each curve."""
    from .. import report
    from ..base.plugin_file import load_plugin
    from ..sources.curves import curves
    from ..study.loading import load_study_or_machine
    from . import outputs

    for one in plugin or ():
        load_plugin(one)
    folder = out or Path("reports") / file.stem / "curves"
    study_or_machine = load_study_or_machine(file)
    outputs.check_folder(folder)
    inner = curves(study_or_machine, speed, option)
    tables = {f"{name}.csv": report.curve_csv(inner, str(name)) for name in inner.data_vars}
    written = outputs.write_analysis(inner, folder, CURVES_NAME, tables, report.curve_figures)
    for name, curve in inner.items():
        typer.echo(f"{name}: {curve.attrs['title']} ({curve.attrs['source']})")
    typer.echo(f"curves: {written}")
