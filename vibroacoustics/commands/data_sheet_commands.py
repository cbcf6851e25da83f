"""Command for the data sheet of an option. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

import typer

from .options import Plugins, ResultsFile, load_plugins, out_option

commands = typer.Typer()


@commands.command("datasheet")
def datasheet_command(
    results_file: ResultsFile,
    option: Annotated[str, typer.Option(help="Balancing option.")] = "none",
    speed: Annotated[
        float | None, typer.Option(help="One of the speeds, rpm; default: the first.")
    ] = None,
    microphones: Annotated[
        str | None,
        typer.Option(help="From which the sound power comes, with commas; default: all."),
    ] = None,
    point: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=X,Y,HEIGHT",
            help="Point of the housing, mm, from the axis and above the floor.",
        ),
    ] = None,
    batch: Annotated[
        float | None,
        typer.Option(
            metavar="DB",
            help="Assumed standard deviation of the machines of a batch; default: one machine.",
        ),
    ] = None,
    out: Annotated[Path | None, out_option("Folder; default: that of the file.")] = None,
    plugin: Plugins = None,
) -> None:
    """Write the data sheet of an option, predicted: page, CSV and JSON (ISO 4871, EN 12102-1)."""
    from .. import report
    from ..declaration.sheet import data_sheet
    from . import arguments, outputs, sheets

    load_plugins(plugin)
    folder = out or results_file.parent
    points_m = arguments.points("--point", point)
    names = None if microphones is None else microphones.split(",")
    outputs.check_folder(folder)
    results, _ = outputs.open_run(results_file)
    with outputs.naming(results_file):
        sheet = data_sheet(results, option, speed, names, points_m, batch)
    written = sheets.write_data_sheet(sheet, folder)
    typer.echo(report.data_sheet_headline(sheet))
    typer.echo(f"data sheet: {written}")
