"""Command for the data sheet of an option. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

from .command import command
from .options import Option, Plugins, Printing, ResultsFile, Speed, load_plugins
from .outcome import Outcome


@command(
    "datasheet",
    "Results",
    "reports/mine/results.nc --option lanchester --speed 2900",
    {"--microphones": "--microphone, once for each microphone"},
)
def datasheet_command(
    results_file: ResultsFile,
    option: Option = "none",
    speed: Speed = None,
    microphone: Annotated[
        list[str] | None,
        "Microphone of the sound power; may be repeated; default: all.",
    ] = None,
    point: Annotated[
        list[str] | None,
        "NAME=X,Y,HEIGHT: point of the housing, mm, from the axis and above the floor.",
    ] = None,
    batch: Annotated[
        float | None,
        "Assumed standard deviation of the machines of a batch, dB; default: one machine.",
    ] = None,
    out: Annotated[Path | None, "Folder; default: that of the file."] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Write the data sheet of an option, predicted: page, CSV and JSON (ISO 4871, EN 12102-1)."""
    from .. import report
    from ..declaration.sheet import data_sheet
    from . import arguments, outputs

    load_plugins(plugin)
    folder = out or results_file.parent
    points_m = arguments.points("--point", point)
    outputs.check_folder(folder)
    prints = printing.printer()
    results, _ = outputs.open_run(results_file)
    with outputs.naming(results_file):
        sheet = data_sheet(results, option, speed, microphone or None, points_m, batch)
    analysis = report.analysis_of_data_sheet(sheet)
    files = outputs.write_analysis(analysis, None, folder, printer=prints)
    return Outcome(files=files, analyses={"": analysis})
