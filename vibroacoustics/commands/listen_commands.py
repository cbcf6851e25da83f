"""Commands that write sound. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated

import typer

from .options import NoCache, Plugins, ResultsFile, load_plugins, out_option, used_cache
from .progress import progress_on_stderr

commands = typer.Typer()


@commands.command("listen")
def listen_command(
    results_file: ResultsFile,
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
        Path | None, out_option("Folder of the sounds; default: sound, beside the file.")
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


@commands.command("impulse-responses")
def impulse_responses_command(
    study_file: Annotated[
        Path, typer.Argument(metavar="STUDY.toml", help="A study with a table `room`.")
    ],
    listener: Annotated[
        list[str] | None, typer.Option(help="Listener in the room; default: all.")
    ] = None,
    full_scale: Annotated[
        float | None,
        typer.Option(
            metavar="PA",
            help="Pa per m/s² or rad/s² at full scale; default: one that all responses fit in.",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        out_option("Folder of the files; default: reports/NAME OF THE STUDY/impulse_responses."),
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
) -> None:
    """Write responses in a room to the shell's accelerations, for listening to measured ones."""
    from .. import pipeline
    from ..study.loading import load_study
    from . import outputs
    from .impulse_files import check_asked, write_impulse_responses

    load_plugins(plugin)
    folder = out or Path("reports") / study_file.stem / "impulse_responses"
    study = load_study(study_file)
    outputs.check_folder(folder)
    with outputs.naming(study_file), used_cache(no_cache), progress_on_stderr() as progress:
        if study.room is not None:
            check_asked(study.room.listeners, listener, full_scale)
        responses = pipeline.impulse_responses(study, progress)
        written = write_impulse_responses(responses, folder, listener or None, full_scale)
    for path in written:
        typer.echo(f"impulse response: {path}")
