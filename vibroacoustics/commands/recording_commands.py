"""Commands for recordings: track, map, export. Heavy imports wait until a command needs them."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    import xarray as xr

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
Rpm = Annotated[float | None, typer.Option(help="Nominal speed, instead of a channel.")]
Tacholess = Annotated[
    tuple[float, float] | None,
    typer.Option(metavar="LOWEST HIGHEST", help="Find the speed in the signal, rpm."),
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
Out = Annotated[
    Path | None,
    typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE FILE."),
]
Plugins = Annotated[
    list[Path] | None,
    typer.Option("--plugin", metavar="FILE.py", help="Python file with readers of yours."),
]


@commands.command("track")
def track_command(
    recording_file: Recording,
    bandwidth: Annotated[
        float, typer.Option(help="Full width at -3 dB of what passes around each order, Hz.")
    ],
    speed: Speed = None,
    pulses: Pulses = 1,
    index: Index = None,
    rpm: Rpm = None,
    tacholess: Tacholess = None,
    orders: Annotated[str, typer.Option(help="Orders to track, with commas.")] = "1,2,3,4",
    poles: Annotated[int, typer.Option(help="1, 2 or 3: steepness of the filter.")] = 2,
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    out: Out = None,
    plugin: Plugins = None,
) -> None:
    """Track orders over the time of a recording (Vold-Kalman): netCDF, figures and a table."""
    from .. import pipeline, report
    from . import arguments, outputs, recorded_outputs

    source = arguments.speed_source(speed, pulses, index, rpm, tacholess)
    numbers = arguments.order_numbers(orders)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = _read(recording_file, unit, calibration, channels, sample_rate, plugin)
    tracked = pipeline.track_orders(recording, source, numbers, bandwidth, poles)
    written = recorded_outputs.write_tracked(tracked, folder)
    typer.echo(report.tracked_text(tracked))
    typer.echo(f"tracked orders: {written}")


@commands.command("map")
def map_command(
    recording_file: Recording,
    speed: Speed = None,
    pulses: Pulses = 1,
    index: Index = None,
    rpm: Rpm = None,
    tacholess: Tacholess = None,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, Hz.")] = 5.0,
    maximum_frequency: Annotated[
        float | None, typer.Option(help="Highest frequency, Hz; default: all.")
    ] = None,
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    out: Out = None,
    plugin: Plugins = None,
) -> None:
    """Draw a recording over speed and frequency (Campbell), and its level over the speed."""
    from .. import pipeline
    from . import arguments, outputs, recorded_outputs

    source = arguments.speed_source(speed, pulses, index, rpm, tacholess)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    recording = _read(recording_file, unit, calibration, channels, sample_rate, plugin)
    mapped = pipeline.speed_frequency_map(recording, source, resolution, maximum_frequency)
    typer.echo(f"speed-frequency map: {recorded_outputs.write_speed_map(mapped, folder)}")


@commands.command("export")
def export_command(
    recording_file: Recording,
    out: Annotated[Path, typer.Option("--out", help="File that ends in .csv, .wav or .nc.")],
    unit: Units = None,
    calibration: Calibration = None,
    channels: Channels = None,
    sample_rate: SampleRate = None,
    plugin: Plugins = None,
) -> None:
    """Write a recording as CSV, WAV or netCDF in SI units."""
    from . import exporting, outputs

    outputs.check_folder(out.parent)
    recording = _read(recording_file, unit, calibration, channels, sample_rate, plugin)
    typer.echo(f"recording: {exporting.export_recording(recording, out)}")


def _read(
    file: Path,
    unit: list[str] | None,
    calibration: list[str] | None,
    channels: str | None,
    sample_rate_hz: float | None,
    plugins: list[Path] | None,
) -> "xr.Dataset":
    """The recording as the options of a command say."""
    from ..base.plugin_file import load_plugin
    from ..recordings import read_recording
    from . import arguments

    for plugin in plugins or ():
        load_plugin(plugin)
    return read_recording(
        file,
        units=arguments.assignments("--unit", unit),
        calibration=arguments.numbers("--calibration", calibration),
        channels=None if channels is None else channels.split(","),
        sample_rate_hz=sample_rate_hz,
    )
