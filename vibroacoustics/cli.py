"""The command line: run, radiation, report, score, doctor.

Heavy imports wait until a command needs them.
"""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from .errors import VibroacousticsError

INPUT_ERROR = 2

app = typer.Typer(
    help="From mechanism to microphone: forces, feet and sound of a compressor.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

StudyFile = Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study to run.")]
ResultsFile = Annotated[Path, typer.Argument(metavar="RESULTS.nc", help="Results of a run.")]


def main() -> None:
    """Run the command line; an input error is one line on stderr and exit code 2."""
    try:
        app()
    except VibroacousticsError as error:
        print(f"error: {' '.join(str(error).split())}", file=sys.stderr)
        sys.exit(INPUT_ERROR)
    except MemoryError as error:
        print(f"error: not enough memory: {error}", file=sys.stderr)
        sys.exit(INPUT_ERROR)


@app.command("run")
def run_command(
    study_file: StudyFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
) -> None:
    """Run a study and write results.nc, report.html, tables and figures."""
    from . import loading, outputs, pipeline, report

    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    with _progress_bar() as progress:
        results = pipeline.run(study, progress)
    written = outputs.write_all(results, folder)
    typer.echo(report.comparison_text(results))
    typer.echo(f"report: {written}")


@app.command("radiation")
def radiation_command(
    study_file: StudyFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
) -> None:
    """Compute the housing's radiation alone: transfer vectors, map, directivity, sound power."""
    from . import loading, outputs, pipeline, report

    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    with _progress_bar() as progress:
        radiated = pipeline.radiate(study, progress)
    written = outputs.write_radiation(radiated, folder)
    typer.echo(report.radiation_text(radiated))
    typer.echo(f"transfer vectors: {written}")


@app.command("report")
def report_command(
    results_file: ResultsFile,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder of the report; default: that of the file.")
    ] = None,
) -> None:
    """Write the report of results again, without computing anything."""
    from . import outputs

    results = outputs.open_run(results_file)
    typer.echo(f"report: {outputs.write_report(results, out or results_file.parent)}")


@app.command("score")
def score_command(
    results_file: ResultsFile,
    scoring_of: Annotated[
        Path | None,
        typer.Option("--scoring", metavar="STUDY.toml", help="Take scales and weights from here."),
    ] = None,
) -> None:
    """Score the options again and print the ranking."""
    from . import loading, outputs, scoring

    results = outputs.open_run(results_file)
    settings = loading.load_study(scoring_of).scoring if scoring_of else None
    typer.echo(scoring.ranking_text(scoring.score(results, settings)))


@app.command("doctor")
def doctor_command() -> None:
    """Tell versions, memory, FFT, k-Wave and cache, without a network."""
    from . import doctor

    for line in doctor.findings():
        typer.echo(line)


@contextmanager
def _progress_bar() -> Iterator[Callable[[str, int, int], None]]:
    """A bar with remaining time on stderr; silent where stderr is no terminal."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    console = Console(stderr=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("ETA"),
        TimeRemainingColumn(),
    )
    tasks: dict[str, TaskID] = {}
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:

        def advance(description: str, done: int, total: int) -> None:
            if description not in tasks:
                tasks[description] = bar.add_task(description, total=total)
            bar.update(tasks[description], completed=done, total=total)

        yield advance
