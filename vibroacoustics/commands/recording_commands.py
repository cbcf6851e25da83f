"""Commands for recordings: orders, track, map, export, tones.

Heavy imports wait until a command needs them.
"""

from pathlib import Path
from typing import Annotated

import typer

from .option_words import in_own_words
from .options import LimitsFile, Paper, Pdf, Plugins
from .progress import progress_on_stderr

commands = typer.Typer()

Recording = Annotated[Path, typer.Argument(metavar="FILE", help="The recording.")]
Speed = Annotated[
    str | None,
    typer.Option(
        help="Channel of the tacho, or of the speed in rpm; with --tacholess, of the signal."
    ),
]
Pulses = Annotated[int, typer.Option(help="Pulses of the tacho per revolution.")]
Index = Annotated[
    str | None, typer.Option(help="Channel with one pulse a revolution: crank angle zero.")
]
Threshold = Annotated[
    float | None,
    typer.Option(help="Level of the tacho that marks the angle, in its unit; default: follows it."),
]
Edge = Annotated[
    str | None,
    typer.Option("--edge", help="Edge of the tacho's pulses: rising or falling; default: auto."),
]
Rpm = Annotated[float | None, typer.Option(help="Nominal speed, instead of a channel.")]
Tacholess = Annotated[
    tuple[float, float] | None,
    typer.Option(metavar="LOWEST HIGHEST", help="Find the speed in the signal, rpm."),
]
Comb = Annotated[
    str | None,
    typer.Option(
        help="With --tacholess: orders that the machine has, with commas; default: 1 to 10."
    ),
]
Mains = Annotated[
    float | None,
    typer.Option(help="With --tacholess: frequency of the mains, Hz; its multiples are left out."),
]
Units = Annotated[
    list[str] | None,
    typer.Option("--unit", metavar="CHANNEL=UNIT", help="Where the file states none."),
]
Calibration = Annotated[
    list[str] | None,
    typer.Option(metavar="CHANNEL=FACTOR", help="Unit per unit stored in the file."),
]
Channels = Annotated[str | None, typer.Option(help="Channels to read, with commas.")]
SampleRate = Annotated[
    float | None, typer.Option(help="Actual sample rate, Hz, instead of the file's.")
]
From = Annotated[
    float | None, typer.Option("--from", help="Begin of the part to read, s from the first sample.")
]
To = Annotated[float | None, typer.Option("--to", help="End of the part to read, s.")]
Out = Annotated[
    Path | None,
    typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE FILE."),
]


@commands.command("orders")
@in_own_words
def orders_command(
    recording_file: Recording,
    speed: Speed = None,
    pulses: Pulses = 1,
    index: Index = None,
    threshold: Threshold = None,
    edge: Edge = None,
    rpm: Rpm = None,
    tacholess: Tacholess = None,
    comb: Comb = None,
    mains: Mains = None,
    orders: Annotated[str, typer.Option(help="Orders wanted, with commas.")] = "1,2,3,4",
    maximum_order: Annotated[float, typer.Option(help="Highest order of spectra and map.")] = 20.0,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, orders.")] = 0.25,
    speed_step: Annotated[float, typer.Option(help="Of a run-up's operating points, rpm.")] = 100.0,
    with_map: Annotated[bool, typer.Option("--map", help="Keep and draw the order map.")] = False,
    bands: Annotated[
        str, typer.Option(help="Third octaves: sums of lines, or filters of IEC 61260-1.")
    ] = "sums",
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    from_s: From = None,
    to_s: To = None,
    out: Out = None,
    limits: LimitsFile = None,
    plugin: Plugins = None,
    pdf: Pdf = False,
    paper: Paper = None,
) -> None:
    """Find the orders of a recording: orders.html, netCDF, CSV, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import analyse_orders
    from . import arguments, checking, outputs, reading
    from .printing import printer

    source = arguments.speed_source(
        speed, pulses, index, rpm, tacholess, comb, mains, threshold, edge
    )
    settings = arguments.order_analysis(
        source, orders, maximum_order, resolution, speed_step, with_map, bands
    )
    folder, prints = out or Path("reports") / recording_file.stem, printer(pdf, paper)
    outputs.check_folder(folder)
    allowed = checking.read(limits)
    recording = reading.Reading(
        recording_file, unit, calibration, channels, sample_rate, from_s, to_s, plugin
    ).in_blocks()
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
def track_command(
    recording_file: Recording,
    bandwidth: Annotated[
        float, typer.Option(help="Full width at -3 dB of what passes around each order, Hz.")
    ],
    speed: Speed = None,
    pulses: Pulses = 1,
    index: Index = None,
    threshold: Threshold = None,
    edge: Edge = None,
    rpm: Rpm = None,
    tacholess: Tacholess = None,
    comb: Comb = None,
    mains: Mains = None,
    orders: Annotated[str, typer.Option(help="Orders to track, with commas.")] = "1,2,3,4",
    poles: Annotated[int, typer.Option(help="1, 2 or 3: steepness of the filter.")] = 2,
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    from_s: From = None,
    to_s: To = None,
    out: Out = None,
    plugin: Plugins = None,
) -> None:
    """Track orders over the time of a recording (Vold-Kalman): netCDF, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import track_orders
    from . import arguments, outputs, reading, recorded_outputs

    source = arguments.speed_source(
        speed, pulses, index, rpm, tacholess, comb, mains, threshold, edge
    )
    numbers = arguments.order_numbers(orders)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = reading.Reading(
        recording_file, unit, calibration, channels, sample_rate, from_s, to_s, plugin
    ).at_once()
    tracked = track_orders(recording, source, numbers, bandwidth, poles)
    written = recorded_outputs.write_tracked(tracked, folder)
    typer.echo(report.tracked_text(tracked))
    typer.echo(f"tracked orders: {written}")


@commands.command("map")
@in_own_words
def map_command(
    recording_file: Recording,
    speed: Speed = None,
    pulses: Pulses = 1,
    index: Index = None,
    threshold: Threshold = None,
    edge: Edge = None,
    rpm: Rpm = None,
    tacholess: Tacholess = None,
    comb: Comb = None,
    mains: Mains = None,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, Hz.")] = 5.0,
    maximum_frequency: Annotated[
        float | None, typer.Option(help="Highest frequency, Hz; default: all.")
    ] = None,
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    from_s: From = None,
    to_s: To = None,
    out: Out = None,
    plugin: Plugins = None,
) -> None:
    """Draw a recording over speed and frequency, its level over the speed: page, figures."""
    from ..measured.recorded_orders import speed_frequency_map
    from . import arguments, outputs, reading, recorded_outputs

    source = arguments.speed_source(
        speed, pulses, index, rpm, tacholess, comb, mains, threshold, edge
    )
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = reading.Reading(
        recording_file, unit, calibration, channels, sample_rate, from_s, to_s, plugin
    ).at_once()
    mapped = speed_frequency_map(recording, source, resolution, maximum_frequency)
    typer.echo(f"speed-frequency map: {recorded_outputs.write_speed_map(mapped, folder)}")
    typer.echo(f"report: {folder / recorded_outputs.SPEED_MAP_REPORT_NAME}")


@commands.command("export")
@in_own_words
def export_command(
    recording_file: Recording,
    out: Annotated[Path, typer.Option("--out", help="File that ends in .csv, .wav or .nc.")],
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    from_s: From = None,
    to_s: To = None,
    plugin: Plugins = None,
) -> None:
    """Write a recording as CSV, WAV or netCDF in SI units."""
    from . import exporting, outputs, reading

    outputs.check_folder(out.parent)
    recording = reading.Reading(
        recording_file, unit, calibration, channels, sample_rate, from_s, to_s, plugin
    ).at_once()
    typer.echo(f"recording: {exporting.export_recording(recording, out)}")


@commands.command("tones")
@in_own_words
def tones_command(
    recording_file: Recording,
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    from_s: From = None,
    to_s: To = None,
    plugin: Plugins = None,
) -> None:
    """Print the tones of a steady recording, prominent or not, with loudness and sharpness."""
    from . import outputs, reading
    from .recorded_tones import tones_text

    recording = reading.Reading(
        recording_file, unit, calibration, channels, sample_rate, from_s, to_s, plugin
    ).at_once()
    with outputs.naming(recording_file):
        typer.echo(tones_text(recording))
