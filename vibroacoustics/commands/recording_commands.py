"""Commands for recordings: orders, track, map, tones, export.

Heavy imports wait until a command needs them.
"""

from pathlib import Path
from typing import Annotated, Final

import typer

from ..base.progress import Progress
from .command import command
from .options import FileOut, LimitsFile, Plugins, Printing, Recording
from .outcome import Outcome
from .reading import Reading
from .speed_options import SpeedOptions

RENAMED: Final = {"--speed": "--speed-channel"}
Orders = Annotated[str, "Shaft orders, with commas."]


@command("orders", "Recordings", "machine.wav --speed-channel tacho --orders 1,2", RENAMED)
def orders_command(
    progress: Progress,
    recording_file: Recording,
    *,
    speed: SpeedOptions,
    orders: Orders = "1,2,3,4",
    maximum_order: Annotated[float, "Highest order of spectra and map."] = 20.0,
    resolution: Annotated[float, "Coarsest resolution, orders."] = 0.25,
    speed_step: Annotated[float, "Step between operating points of a run-up, rpm."] = 100.0,
    with_map: Annotated[bool, typer.Option("--map", help="Keep and draw the order map.")] = False,
    bands: Annotated[str, "Third octaves: sums of lines, or filters of IEC 61260-1."] = "sums",
    reading: Reading,
    out: FileOut = None,
    limits: LimitsFile = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Find the orders of a recording: orders.html, netCDF, CSV, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import analyse_orders
    from ..study.order_analysis import BAND_METHODS, OrderAnalysis
    from . import arguments, checking, outputs

    settings = OrderAnalysis(
        speed.source(),
        arguments.order_numbers(orders),
        maximum_order,
        resolution,
        speed_step,
        with_map,
        arguments.chosen("--bands", bands, BAND_METHODS),
    )
    folder, prints = out or Path("reports") / recording_file.stem, printing.printer()
    outputs.check_folder(folder)
    allowed = checking.read(limits)
    recording = reading.in_blocks(recording_file, plugin)
    results = checking.held_against(analyse_orders(recording, settings, progress), allowed)
    analysis = report.analysis_of_orders(results)
    return Outcome(
        files=outputs.write_analysis(analysis, results, folder, "orders.nc", prints),
        analyses={"": analysis},
        broken=report.broken_lines(results, ()),
    )


@command("track", "Recordings", "run_up.csv --speed-channel tacho --bandwidth 3", RENAMED)
def track_command(
    recording_file: Recording,
    *,
    bandwidth: Annotated[float, "Full width at -3 dB of what passes around each order, Hz."],
    speed: SpeedOptions,
    orders: Orders = "1,2,3,4",
    poles: Annotated[int, "1, 2 or 3: steepness of the filter."] = 2,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Track orders over the time of a recording (Vold-Kalman): netCDF, figures and a table."""
    from .. import report
    from ..measured.recorded_orders import track_orders
    from . import arguments, outputs

    source = speed.source()
    numbers = arguments.order_numbers(orders)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    prints = printing.printer()
    recording = reading.at_once(recording_file, plugin)
    tracked = track_orders(recording, source, numbers, bandwidth, poles)
    analysis = report.analysis_of_tracks(tracked)
    files = outputs.write_analysis(analysis, tracked, folder, "tracked_orders.nc", prints)
    return Outcome(files=files, analyses={"": analysis})


@command("map", "Recordings", "run_up.csv --speed-channel tacho --resolution 4", RENAMED)
def map_command(
    recording_file: Recording,
    *,
    speed: SpeedOptions,
    resolution: Annotated[float, "Coarsest resolution, Hz."] = 5.0,
    maximum_frequency: Annotated[float | None, "Highest frequency, Hz; default: all."] = None,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Draw a recording over speed and frequency, its level over the speed: page, figures."""
    from .. import report
    from ..measured.recorded_orders import speed_frequency_map
    from . import outputs

    source = speed.source()
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    prints = printing.printer()
    recording = reading.at_once(recording_file, plugin)
    mapped = speed_frequency_map(recording, source, resolution, maximum_frequency)
    analysis = report.analysis_of_map(mapped)
    files = outputs.write_analysis(analysis, mapped, folder, "speed_map.nc", prints)
    return Outcome(files=files, analyses={"": analysis})


@command("tones", "Recordings", 'machine.wav --unit "channel 1=Pa"')
def tones_command(
    recording_file: Recording,
    *,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Find the tones of a steady recording, prominent or not, with loudness and sharpness."""
    from ..measured.recorded_tones import recorded_tones
    from . import outputs
    from .tone_tables import analysis_of_tones

    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    prints = printing.printer()
    recording = reading.at_once(recording_file, plugin)
    with outputs.naming(recording_file):
        tones = recorded_tones(recording)
    analysis = analysis_of_tones(tones)
    files = outputs.write_analysis(analysis, tones, folder, "tones.nc", prints)
    return Outcome(files=files, analyses={"": analysis})


@command("export", "Recordings", "machine.uff --out machine.csv", computes=False)
def export_command(
    recording_file: Recording,
    *,
    out: Annotated[Path, "File that ends in .csv, .wav or .nc."],
    reading: Reading,
    plugin: Plugins = None,
) -> Outcome:
    """Write a recording as CSV, WAV or netCDF in SI units."""
    from . import exporting, outputs

    outputs.check_folder(out.parent)
    recording = reading.at_once(recording_file, plugin)
    return Outcome(files={"recording": exporting.export_recording(recording, out)})
