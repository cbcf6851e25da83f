"""Command for the sound power from recorded microphones. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated, Final

import typer

from .option_words import in_own_words
from .options import Plugins, out_option
from .reading import Reading, SampleRate

SOUND_POWER_NAME: Final = "sound_power.nc"

commands = typer.Typer()


@commands.command("sound-power")
@in_own_words
def sound_power_command(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="Recordings of the microphones.")
    ],
    hemisphere: Annotated[
        float | None, typer.Option(metavar="RADIUS", help="They stand on a hemisphere, m.")
    ] = None,
    box: Annotated[
        tuple[float, float, float, float] | None,
        typer.Option(
            metavar="LENGTH WIDTH HEIGHT DISTANCE",
            help="They stand on a box: edges of the smallest around the machine, distance, m.",
        ),
    ] = None,
    background: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="Recording while the machine stands still."),
    ] = None,
    absorption_area: Annotated[
        str | None,
        typer.Option(metavar="M2", help="Of the room, m², or CSV by band; default: free field."),
    ] = None,
    reverberation_time: Annotated[
        str | None, typer.Option(metavar="S", help="Of the room, s, or CSV by band.")
    ] = None,
    volume: Annotated[
        float | None, typer.Option(metavar="M3", help="Of the room, m³, beside its reverberation.")
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option("--unit", metavar="[FILE:]CHANNEL=UNIT", help="Where a file states none."),
    ] = None,
    calibration: Annotated[
        list[str] | None,
        typer.Option(metavar="[FILE:]CHANNEL=FACTOR", help="Unit per unit stored in the file."),
    ] = None,
    sample_rate: SampleRate = None,
    out: Annotated[
        Path | None, out_option("Folder of the results; default: reports/NAME OF THE FIRST.")
    ] = None,
    plugin: Plugins = None,
) -> None:
    """Sound power of a machine from the microphones around it, with K1 and K2 (ISO 3744)."""
    from .. import report
    from ..measured.sound_power import sound_power
    from . import microphones, outputs

    folder, quiet = out or Path("reports") / files[0].stem, background or []
    surface = microphones.surface_of(hemisphere, box)
    absorption = microphones.absorption_of(absorption_area, reverberation_time, volume)
    outputs.check_folder(folder)
    reading = Reading(unit, calibration, sample_rate=sample_rate)
    given = ([*files, *quiet], reading, plugin)
    running, still = (microphones.read_files(each, *given) for each in (files, quiet))
    measured = sound_power(running, surface, still, absorption)
    tables = {
        "sound_power.csv": report.measured_power_csv(measured),
        "sound_power.html": report.measured_power_html(measured),
    }
    written = outputs.write_analysis(measured, folder, SOUND_POWER_NAME, tables, lambda _: [])
    typer.echo(report.measured_power_text(measured))
    typer.echo(f"sound power: {written}")
    typer.echo(f"report: {folder / 'sound_power.html'}")
