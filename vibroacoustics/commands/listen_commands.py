"""Command that writes sound. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

import typer

commands = typer.Typer()


@commands.command("listen")
def listen_command(
    results_file: Annotated[Path, typer.Argument(metavar="RESULTS.nc", help="Results of a run.")],
    option: Annotated[
        list[str] | None, typer.Option(help="Option to listen to; default: all.")
    ] = None,
    microphone: Annotated[
        list[str] | None,
        typer.Option(help="Microphone, or listener in a room; default: the first."),
    ] = None,
    speed: Annotated[
        list[float] | None, typer.Option(help="Speed, rpm; default: the first.")
    ] = None,
    seconds: Annotated[
        float, typer.Option(help="Duration, s, rounded to whole revolutions; 1 to 600.")
    ] = 10.0,
    full_scale: Annotated[
        float | None,
        typer.Option(
            metavar="PA",
            help="Pressure at full scale, Pa; default: one that all sounds of the results fit in.",
        ),
    ] = None,
    calibration: Annotated[
        float | None,
        typer.Option(metavar="DB", help="A tone of 1 kHz of this level too, dB re 20 µPa."),
    ] = None,
    file_format: Annotated[
        str, typer.Option("--format", help="wav, or flac (extra `sound`).")
    ] = "wav",
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the sounds; default: sound, beside the file."),
    ] = None,
) -> None:
    """Write the sound of options where one listens, all at one gain, which the names state."""
    from . import outputs
    from .listening import listen

    results, _ = outputs.open_run(results_file)
    with outputs.naming(results_file):
        written = listen(
            results,
            out or results_file.parent / "sound",
            option or None,
            microphone or None,
            speed or None,
            duration_s=seconds,
            full_scale_pa=full_scale,
            calibration_db=calibration,
            file_format=file_format,
        )
    for path in written:
        typer.echo(f"sound: {path}")
