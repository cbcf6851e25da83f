"""Command for the sound power from recorded microphones. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

from .command import command
from .options import Plugins, Printing
from .outcome import Outcome
from .reading import Reading, SampleRate


@command("sound-power", "Recordings", 'front.wav rear.wav --hemisphere 1.0 --unit "channel 1=Pa"')
def sound_power_command(
    files: Annotated[
        list[Path],
        "RECORDING: Files of the microphones' recordings.",
    ],
    hemisphere: Annotated[float | None, "Radius of the hemisphere of the microphones, m."] = None,
    box: Annotated[
        tuple[float, float, float, float] | None,
        "Box of the microphones: length, width and height of the smallest box around the "
        "machine, distance from it, m.",
    ] = None,
    background: Annotated[
        list[Path] | None,
        "Recording without the machine running; may be repeated.",
    ] = None,
    absorption_area: Annotated[
        str | None,
        "Absorption area of the room, m², or CSV file by band; default: free field.",
    ] = None,
    reverberation_time: Annotated[
        str | None, "Reverberation time of the room, s, or CSV file by band."
    ] = None,
    volume: Annotated[float | None, "Volume of the room, m³, with its reverberation time."] = None,
    unit: Annotated[
        list[str] | None,
        "CHANNEL=UNIT or FILE:CHANNEL=UNIT, where a file states none.",
    ] = None,
    calibration: Annotated[
        list[str] | None,
        "CHANNEL=FACTOR or FILE:CHANNEL=FACTOR: unit per unit stored in the file.",
    ] = None,
    sample_rate: SampleRate = None,
    out: Annotated[
        Path | None, "Folder of the results; default: reports/NAME OF THE FIRST."
    ] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Measure the sound power of a machine with the microphones around it, K1 and K2 (ISO 3744)."""
    from .. import report
    from ..measured.sound_power import sound_power
    from . import microphones, outputs

    folder, quiet = out or Path("reports") / files[0].stem, background or []
    surface = microphones.surface_of(hemisphere, box)
    absorption = microphones.absorption_of(absorption_area, reverberation_time, volume)
    outputs.check_folder(folder)
    prints = printing.printer()
    reading = Reading(unit, calibration, sample_rate=sample_rate)
    given = ([*files, *quiet], reading, plugin)
    running, still = (microphones.read_files(each, *given) for each in (files, quiet))
    measured = sound_power(running, surface, still, absorption)
    analysis = report.analysis_of_sound_power(measured)
    files_of = outputs.write_analysis(analysis, measured, folder, "sound_power.nc", prints)
    return Outcome(files=files_of, analyses={"": analysis})
