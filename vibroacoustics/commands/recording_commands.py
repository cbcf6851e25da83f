"""Commands for recordings: orders, track, map, export, tones.

Heavy imports wait until a command needs them.
"""

from pathlib import Path
from typing import Annotated

import typer

from .grouped import with_groups
from .option_words import in_own_words
from .options import FileOut, LimitsFile, Paper, Pdf, Plugins
from .progress import progress_on_stderr
from .reading import Reading
from .speed_options import SpeedOptions

commands = typer.Typer()

Recording = Annotated[Path, typer.Argument(metavar="FILE", help="The recording.")]


@commands.command("orders")
@in_own_words
@with_groups
def orders_command(
    recording_file: Recording,
    *,
    speed: SpeedOptions,
    orders: Annotated[str, typer.Option(help="Orders wanted, with commas.")] = "1,2,3,4",
    maximum_order: Annotated[float, typer.Option(help="Highest order of spectra and map.")] = 20.0,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, orders.")] = 0.25,
    speed_step: Annotated[float, typer.Option(help="Of a run-up's operating points, rpm.")] = 100.0,
    with_map: Annotated[bool, typer.Option("--map", help="Keep and draw the order map.")] = False,
    bands: Annotated[
        str, typer.Option(help="Third octaves: sums of lines, or filters of IEC 61260-1.")
    ] = "sums",
    reading: Reading,
    out: FileOut = None,
    limits: LimitsFile = None,
    plugin: Plugins = None,
    pdf: Pdf = False,
    paper: Paper = None,
) -> None:
    """Find the orders of a recording: orders.html, netCDF, CSV, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import analyse_orders
    from ..study.order_analysis import BAND_METHODS, OrderAnalysis
    from . import arguments, checking, outputs
    from .printing import printer

    source = speed.source()
    settings = OrderAnalysis(
        source,
        arguments.order_numbers(orders),
        maximum_order,
        resolution,
        speed_step,
        with_map,
        arguments.chosen("--bands", bands, BAND_METHODS),
    )
    folder, prints = out or Path("reports") / recording_file.stem, printer(pdf, paper)
    outputs.check_folder(folder)
    allowed = checking.read(limits)
    recording = reading.in_blocks(recording_file, plugin)
    with progress_on_stderr() as progress:
        results = analyse_orders(recording, settings, progress)
        results = checking.held_against(results, allowed)
        written = outputs.write_orders(results, folder, prints)
    typer.echo(report.orders_text(results))
    checking.print_margins(results, folder / outputs.LIMITS_NAME)
    typer.echo(f"orders: {written}")
    typer.echo(f"report: {folder / outputs.ORDERS_REPORT_NAME}")
    if prints is not None:
        typer.echo(f"pdf: {(folder / outputs.ORDERS_REPORT_NAME).with_suffix('.pdf')}")


@commands.command("track")
@in_own_words
@with_groups
def track_command(
    recording_file: Recording,
    *,
    bandwidth: Annotated[
        float, typer.Option(help="Full width at -3 dB of what passes around each order, Hz.")
    ],
    speed: SpeedOptions,
    orders: Annotated[str, typer.Option(help="Orders to track, with commas.")] = "1,2,3,4",
    poles: Annotated[int, typer.Option(help="1, 2 or 3: steepness of the filter.")] = 2,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
) -> None:
    """Track orders over the time of a recording (Vold-Kalman): netCDF, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import track_orders
    from . import arguments, outputs, recorded_outputs

    source = speed.source()
    numbers = arguments.order_numbers(orders)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = reading.at_once(recording_file, plugin)
    tracked = track_orders(recording, source, numbers, bandwidth, poles)
    written = recorded_outputs.write_tracked(tracked, folder)
    typer.echo(report.tracked_text(tracked))
    typer.echo(f"tracked orders: {written}")


@commands.command("map")
@in_own_words
@with_groups
def map_command(
    recording_file: Recording,
    *,
    speed: SpeedOptions,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, Hz.")] = 5.0,
    maximum_frequency: Annotated[
        float | None, typer.Option(help="Highest frequency, Hz; default: all.")
    ] = None,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
) -> None:
    """Draw a recording over speed and frequency, its level over the speed: page, figures."""
    from ..measured.recorded_orders import speed_frequency_map
    from . import outputs, recorded_outputs

    source = speed.source()
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = reading.at_once(recording_file, plugin)
    mapped = speed_frequency_map(recording, source, resolution, maximum_frequency)
    typer.echo(f"speed-frequency map: {recorded_outputs.write_speed_map(mapped, folder)}")
    typer.echo(f"report: {folder / recorded_outputs.SPEED_MAP_REPORT_NAME}")


@commands.command("export")
@in_own_words
@with_groups
def export_command(
    recording_file: Recording,
    *,
    out: Annotated[Path, typer.Option("--out", help="File that ends in .csv, .wav or .nc.")],
    reading: Reading,
    plugin: Plugins = None,
) -> None:
    """Write a recording as CSV, WAV or netCDF in SI units."""
    from . import exporting, outputs

    outputs.check_folder(out.parent)
    recording = reading.at_once(recording_file, plugin)
    typer.echo(f"recording: {exporting.export_recording(recording, out)}")


@commands.command("tones")
@in_own_words
@with_groups
def tones_command(
    recording_file: Recording,
    *,
    reading: Reading,
    plugin: Plugins = None,
) -> None:
    """Print the tones of a steady recording, prominent or not, with loudness and sharpness."""
    from . import outputs
    from .recorded_tones import tones_text

    recording = reading.at_once(recording_file, plugin)
    with outputs.naming(recording_file):
        typer.echo(tones_text(recording))
