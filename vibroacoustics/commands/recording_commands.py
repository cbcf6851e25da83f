"""Commands for recordings: orders, track, map, tones, export, sound-power.

Heavy imports wait until a command needs them, and until a file is read that may be refused.
"""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Final

from ..base.progress import Progress
from .command import command
from .options import FileOut, LimitsFile, Plugins, Printing, Recording, load_plugins
from .outcome import Outcome
from .reading import (
    Calibrator,
    CalibratorFrequency,
    CalibratorLevel,
    OrderOptions,
    Reading,
    SampleRate,
    Settings,
    SpeedOptions,
)

Orders = Annotated[str | None, "Shaft orders, with commas; default: 1,2,3,4."]
LOUDEST: Final[dict[str, Any]] = {"orders": ()}
"""Orders of an analysis of one recording that names none: 1, 2 and the loudest."""


@command("orders", "Recordings", "machine.wav --speed-channel tacho --orders 1,2")
def orders_command(
    progress: Progress,
    files: Annotated[list[Path], "RECORDING: File of the recording, or several to be averaged."],
    *,
    speed: SpeedOptions,
    orders: OrderOptions,
    listen: Annotated[
        str | None, "Channel whose map and sound are on the page of a run-up; default: first in Pa."
    ] = None,
    reading: Reading,
    out: FileOut = None,
    limits: LimitsFile = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Find the orders of a recording, or mean and scatter of many: page, netCDF, CSV, figures."""
    from ..base.errors import ParameterError
    from ..results.limits_file import read_limits

    name = reading.settings if len(files) > 1 and reading.settings is not None else files[0]
    folder = out or Path("reports") / name.stem
    allowed = read_limits(limits) if limits else ()
    if len(files) > 1:
        from .. import report
        from ..measured.campaign import analyse_campaign
        from ..results.order_limits import with_limits

        if listen is not None or orders.with_map:
            raise ParameterError("--listen, --map: need one recording: give one file")
        target = printing.target(folder)
        load_plugins(plugin)
        run_of = partial(reading.run, speed, replace(orders, with_map=False), plugin)
        results = with_limits(analyse_campaign(files, run_of, progress), allowed)
        analysis, dataset_name = report.analysis_of_campaign(results), "campaign.nc"
    else:
        source = reading.source(speed, files[0], plugin)
        settings = orders.analysis(source, LOUDEST | reading.stated_analysis())
        recording = reading.in_blocks(files[0], plugin, speed)
        from .. import report
        from ..measured.recorded_orders import analyse_orders
        from ..measured.run_up_sound import check_listen, listened
        from ..orders.recorded_speed import recorded_speed
        from ..results import provenance
        from ..results.order_limits import with_limits

        target = printing.target(folder)
        check_listen(recording, settings, listen)
        with provenance.naming(recording.attributes):
            shaft = recorded_speed(recording, settings.speed)
        results = with_limits(analyse_orders(recording, settings, progress, shaft), allowed)
        sound = listened(recording, settings, results, listen, shaft.motion)
        analysis, dataset_name = report.analysis_of_orders(results, listen, sound), "orders.nc"
    broken = report.broken_lines(results, ())
    return target.outcome(analysis, results, dataset_name, broken)


@command("track", "Recordings", "run_up.csv --speed-channel tacho --bandwidth 3")
def track_command(
    recording_file: Recording,
    *,
    bandwidth: Annotated[float, "Full width at -3 dB of what passes around each order, Hz."],
    speed: SpeedOptions,
    orders: Orders = None,
    poles: Annotated[int, "1, 2 or 3: steepness of the filter."] = 2,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Track orders over the time of a recording (Vold-Kalman): netCDF, figures and a table."""
    from .arguments import order_numbers

    source = reading.source(speed, recording_file, plugin)
    numbers = None if orders is None else order_numbers(orders)
    recording = reading.at_once(recording_file, plugin, speed)
    from .. import report
    from ..measured.recorded_orders import track_orders

    target = printing.target(out or Path("reports") / recording_file.stem)
    tracked = track_orders(recording, source, numbers, bandwidth, poles)
    return target.outcome(report.analysis_of_tracks(tracked), tracked, "tracked_orders.nc")


@command("map", "Recordings", "run_up.csv --speed-channel tacho --resolution 4")
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
    source = reading.source(speed, recording_file, plugin)
    recording = reading.at_once(recording_file, plugin, speed)
    from .. import report
    from ..measured.recorded_orders import speed_frequency_map

    target = printing.target(out or Path("reports") / recording_file.stem)
    mapped = speed_frequency_map(recording, source, resolution, maximum_frequency)
    return target.outcome(report.analysis_of_map(mapped), mapped, "speed_map.nc")


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
    recording = reading.at_once(recording_file, plugin)
    from ..measured.recorded_tones import recorded_tones
    from . import outputs
    from .tone_tables import analysis_of_tones

    target = printing.target(out or Path("reports") / recording_file.stem)
    with outputs.naming(recording_file):
        tones = recorded_tones(recording)
    return target.outcome(analysis_of_tones(tones), tones, "tones.nc")


@command("export", "Recordings", "machine.uff --out machine.csv", computes=False)
def export_command(
    recording_file: Recording,
    *,
    out: Annotated[Path, "File that ends in .csv, .wav or .nc."],
    reading: Reading,
    plugin: Plugins = None,
) -> Outcome:
    """Write a recording as CSV, WAV or netCDF in SI units."""
    recording = reading.at_once(recording_file, plugin)
    from . import exporting, outputs

    outputs.check_folder(out.parent)
    return Outcome(files={"recording": exporting.export_recording(recording, out)})


@command("sound-power", "Recordings", 'front.wav rear.wav --hemisphere 1.0 --unit "channel 1=Pa"')
def sound_power_command(
    files: Annotated[list[Path], "RECORDING: Files of the microphones' recordings."],
    hemisphere: Annotated[float | None, "Radius of the hemisphere of the microphones, m."] = None,
    box: Annotated[
        tuple[float, float, float, float] | None,
        "Box of the microphones: length, width and height of the smallest box around the "
        "machine, distance from it, m.",
    ] = None,
    background: Annotated[
        list[Path] | None, "Recording without the machine running; may be repeated."
    ] = None,
    absorption_area: Annotated[
        str | None, "Absorption area of the room, m², or CSV file by band; default: free field."
    ] = None,
    reverberation_time: Annotated[
        str | None, "Reverberation time of the room, s, or CSV file by band."
    ] = None,
    volume: Annotated[float | None, "Volume of the room, m³, with its reverberation time."] = None,
    unit: Annotated[
        list[str] | None, "CHANNEL=UNIT or FILE:CHANNEL=UNIT, where a file states none."
    ] = None,
    calibration: Annotated[
        list[str] | None, "CHANNEL=FACTOR or FILE:CHANNEL=FACTOR: unit per unit stored in the file."
    ] = None,
    calibrator: Calibrator = None,
    calibrator_level: CalibratorLevel = 94.0,
    calibrator_frequency: CalibratorFrequency = 1000.0,
    sample_rate: SampleRate = None,
    settings: Settings = None,
    out: Annotated[
        Path | None, "Folder of the results; default: reports/NAME OF THE FIRST."
    ] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Measure the sound power of a machine with the microphones around it, K1 and K2 (ISO 3744)."""
    from . import microphones

    quiet = background or []
    reading = Reading(
        unit,
        calibration,
        sample_rate=sample_rate,
        calibrator=calibrator,
        calibrator_level=calibrator_level,
        calibrator_frequency=calibrator_frequency,
        settings=settings,
    )
    recordings = microphones.read_files([*files, *quiet], reading, plugin)
    running, still = recordings[: len(files)], recordings[len(files) :]
    from .. import report
    from ..measured.sound_power import sound_power

    surface = microphones.surface_of(hemisphere, box)
    absorption = microphones.absorption_of(absorption_area, reverberation_time, volume)
    target = printing.target(out or Path("reports") / files[0].stem)
    measured = sound_power(running, surface, still, absorption)
    return target.outcome(report.analysis_of_sound_power(measured), measured, "sound_power.nc")
