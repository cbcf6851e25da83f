"""Commands that write sound. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated

import typer

from ..base.progress import Progress
from .command import command
from .options import NoCache, Plugins, Printing, ResultsFile, StudyFile, load_plugins, used_cache
from .outcome import Outcome


@command("listen", "Results", "reports/mine/results.nc --option none --option lanchester")
def listen_command(
    results_file: ResultsFile,
    option: Annotated[list[str] | None, "Option to listen to; default: all."] = None,
    microphone: Annotated[
        list[str] | None,
        "Microphone, also in a room; may be repeated; default: the first.",
    ] = None,
    speed: Annotated[
        list[float] | None,
        "Shaft speed, rpm; may be repeated; default: the first.",
    ] = None,
    seconds: Annotated[float, "Duration, s, rounded to whole revolutions; 1 to 600."] = 10.0,
    full_scale: Annotated[
        float | None,
        "Pressure at full scale, Pa; default: one that all sounds of the results fit in.",
    ] = None,
    calibration: Annotated[float | None, "Level of a further tone of 1 kHz, dB re 20 µPa."] = None,
    file_format: Annotated[
        str, typer.Option("--format", help="wav, or flac (extra `sound`).")
    ] = "wav",
    out: Annotated[Path | None, "Folder of the sounds; default: sound, beside the file."] = None,
) -> Outcome:
    """Write the sound of options at microphones, all at one gain, which the names state."""
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
    return Outcome(files={f"sound {number}": path for number, path in enumerate(written, 1)})


@command(
    "impulse-responses",
    "Results",
    "kitchen.toml --microphone table",
    {"--listener": "--microphone"},
)
def impulse_responses_command(
    progress: Progress,
    study_file: StudyFile,
    microphone: Annotated[
        list[str] | None,
        "Microphone in the room; may be repeated; default: all.",
    ] = None,
    full_scale: Annotated[
        float | None,
        "Pa per m/s² or rad/s² at full scale; default: one that all responses fit in.",
    ] = None,
    out: Annotated[
        Path | None,
        "Folder of the files; default: reports/NAME OF THE STUDY/impulse_responses.",
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
    *,
    printing: Printing,
) -> Outcome:
    """Write responses in a room to the shell's accelerations, for listening to measured ones."""
    from .. import pipeline
    from ..study.loading import load_study
    from . import outputs
    from .impulse_files import check_asked, impulse_analysis

    load_plugins(plugin)
    folder = out or Path("reports") / study_file.stem / "impulse_responses"
    study = load_study(study_file)
    outputs.check_folder(folder)
    prints = printing.printer()
    with outputs.naming(study_file), used_cache(no_cache):
        if study.room is not None:
            check_asked(study.room.listeners, microphone, full_scale)
        responses = pipeline.impulse_responses(study, progress)
        analysis = impulse_analysis(responses, microphone or None, full_scale)
    files = outputs.write_analysis(analysis, None, folder, printer=prints)
    return Outcome(files=files, analyses={"": analysis})
