"""The command line: run, radiation, orders, compare, predict, report, score, cache and others.

Heavy imports wait until a command needs them.
"""

import gc
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from ..base.errors import VibroacousticsError
from ..base.fault import collected
from . import (
    check_commands,
    comparison_commands,
    curve_commands,
    data_sheet_commands,
    design_commands,
    listen_commands,
    messages,
    prediction_commands,
    recording_commands,
    run_commands,
    schema_commands,
    score_commands,
    sound_power_commands,
)
from .options import (
    NoCache,
    Paper,
    Pdf,
    Plugins,
    ResultsFile,
    StudyOut,
    load_plugins,
    out_option,
    used_cache,
)
from .progress import progress_on_stderr

if TYPE_CHECKING:
    from ..study.study import Study

INPUT_ERROR = 2
NOT_COMPLETE = 3
COLLECTIONS: Final = (100_000, 10, 10)
"""Thresholds of the collector of cyclic garbage: imports and figures make next to none of it, and
at the usual 700 it takes a tenth of a run's time."""

app = typer.Typer(
    help="From mechanism to microphone: forces, feet and sound of a compressor.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

for _module in (
    run_commands,
    curve_commands,
    recording_commands,
    sound_power_commands,
    comparison_commands,
    prediction_commands,
    design_commands,
    schema_commands,
    check_commands,
    score_commands,
    data_sheet_commands,
    listen_commands,
):
    app.add_typer(_module.commands)

StudyFile = Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study to run.")]


def _print_version(asked: bool) -> None:
    if asked:
        from importlib.metadata import version

        typer.echo(f"vibroacoustics {version('vibroacoustics')}")
        raise typer.Exit


@app.callback()
def of_all_commands(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print it.")
    ] = False,
) -> None:
    """From mechanism to microphone: forces, feet and sound of a compressor."""


def main() -> None:
    """Run the command line; input errors are lines on stderr and exit code 2."""
    gc.set_threshold(*COLLECTIONS)
    try:
        with messages.warnings_in_one_line(), collected() as left_out:
            _run(left_out)
    except VibroacousticsError as error:
        for line in messages.lines_of(error):
            print(line, file=sys.stderr)
        sys.exit(INPUT_ERROR)
    except MemoryError as error:
        print(f"error: not enough memory: {error}", file=sys.stderr)
        sys.exit(INPUT_ERROR)
    finally:
        gc.freeze()  # the interpreter would search all objects before it ends, for a second


def _run(left_out: list[str]) -> None:
    """Run a command; one that ends well, but without what failed in a plug-in, exits with 3."""
    try:
        app()
    except SystemExit as ended:
        if left_out and not ended.code:
            sys.exit(NOT_COMPLETE)
        raise


@app.command("radiation")
def radiation_command(
    study_file: StudyFile,
    out: StudyOut = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
) -> None:
    """Compute the housing's radiation alone: transfer vectors, map, directivity, sound power."""
    from .. import pipeline, report
    from . import outputs

    study, folder = _study_and_folder(study_file, out, plugin)
    with used_cache(no_cache), progress_on_stderr() as progress:
        radiated = pipeline.radiate(study, progress)
    written = outputs.write_radiation(radiated, folder)
    typer.echo(report.radiation_text(radiated))
    typer.echo(f"transfer vectors: {written}")


@app.command("report")
def report_command(
    results_file: ResultsFile,
    out: Annotated[
        Path | None, out_option("Folder of the report; default: that of the file.")
    ] = None,
    plugin: Plugins = None,
    pdf: Pdf = False,
    paper: Paper = None,
) -> None:
    """Write the report of results again, without computing anything; as PDF, too."""
    from . import outputs
    from .printing import printer

    load_plugins(plugin)
    prints = printer(pdf, paper)
    folder = out or results_file.parent
    written = outputs.write_report_again(results_file, folder, prints)
    typer.echo(f"report: {written}")
    if prints is not None:
        typer.echo(f"pdf: {written.with_suffix('.pdf')}")
    messages.warn(outputs.older_files(folder))


@app.command("cache")
def cache_command(
    clear: Annotated[bool, typer.Option("--clear", help="Remove all of it.")] = False,
    limit: Annotated[
        float | None,
        typer.Option(
            metavar="GB",
            min=0.0,
            max=1e6,
            help="Largest size from now on; default: 2. Oldest use goes first.",
        ),
    ] = None,
) -> None:
    """List what is cached, the least recently used first; clear it or limit its size."""
    from . import caching

    for line in caching.lines(clear, limit):
        typer.echo(line)


@app.command("doctor")
def doctor_command(
    folder: Annotated[
        Path | None, typer.Argument(metavar="[FOLDER]", help="Check the results in it, too.")
    ] = None,
) -> None:
    """Tell versions, memory, FFT, k-Wave and cache, without a network."""
    from . import doctor

    for line in doctor.findings(folder):
        typer.echo(line)


def _study_and_folder(
    study_file: Path, out: Path | None, plugins: list[Path] | None
) -> "tuple[Study, Path]":
    """The study and the folder of its results, which can be written."""
    from ..study import loading
    from . import outputs

    load_plugins(plugins)
    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    return study, folder
