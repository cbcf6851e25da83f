"""Command that runs studies. Heavy imports wait until it runs."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..base.errors import ParameterError
from ..base.progress import Progress
from . import messages
from .options import NoCache, Plugins, load_plugins, out_option, used_cache
from .progress import progress_on_stderr

if TYPE_CHECKING:
    from ..study.study import Study

commands = typer.Typer()

StudyFiles = Annotated[
    list[Path], typer.Argument(metavar="STUDY.toml...", help="The studies to run.")
]
Out = Annotated[
    Path | None,
    out_option(
        "Folder of the results; of several studies one in it each; "
        "default: reports/NAME OF THE STUDY."
    ),
]
Coarse = Annotated[
    bool,
    typer.Option(
        "--coarse",
        help="A first look: fewer speeds and samples, coarser grids, with its error told.",
    ),
]
AsJson = Annotated[
    bool, typer.Option("--json", help="Print a summary as JSON on stdout, and no other words.")
]
Quiet = Annotated[
    bool, typer.Option("--quiet", help="Print nothing but warnings and errors, and --json.")
]
Verbose = Annotated[
    bool, typer.Option("--verbose", help="A line for every stage, however short, on stderr.")
]
Without = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME", help="Source of the studies that is omitted; may be repeated."),
]
Log = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Append stages, warnings and errors with their times."),
]


@commands.command("run")
def run_command(
    study_files: StudyFiles,
    out: Out = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
    coarse: Coarse = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
    log: Log = None,
    without: Without = None,
) -> None:
    """Run studies and write results.nc, report.html, tables and figures of each."""
    with messages.logged(log):
        load_plugins(plugin)
        studies = _studies(study_files, out, coarse, without or ())
        summaries = []
        with used_cache(no_cache), progress_on_stderr(quiet, verbose) as progress:
            for number, (study, folder) in enumerate(studies):
                if len(studies) > 1:
                    progress("all studies", number, len(studies))
                summaries.append(_run(study, folder, progress, quiet or as_json))
            if len(studies) > 1:
                progress("all studies", len(studies), len(studies))
    if as_json:
        import json

        typer.echo(json.dumps({"studies": summaries}, indent=1))


def _studies(
    files: Sequence[Path], out: Path | None, coarse: bool, without: Sequence[str]
) -> "list[tuple[Study, Path]]":
    """Studies with the folders of their results; all are read before the first one runs."""
    from ..study.coarse import coarse as coarser
    from ..study.loading import load_study
    from . import outputs

    studies: list[tuple[Study, Path]] = []
    for file in files:
        inner = out / file.stem if out and len(files) > 1 else out
        folder = inner or Path("reports") / file.stem
        if folder in [other for _, other in studies]:
            raise ParameterError(f"{file}: two studies would write to {folder}; run one by one")
        study = load_study(file, without)
        outputs.check_folder(folder, outputs.RUN_FILES)
        if coarse:
            study = coarser(study)
            if not study.coarsened:
                messages.warn([f"{file}: has nothing to coarsen; it runs in full"])
        studies.append((study, folder))
    return studies


def _run(study: "Study", folder: Path, progress: Progress, silent: bool) -> dict[str, Any]:
    """Run one study and write its files; its summary."""
    from .. import pipeline, report
    from . import outputs
    from .summary import summary

    start = time.monotonic()
    messages.note(f"run: {study.source_file}")
    results = pipeline.run(study, progress)
    progress("report", 0, 1)
    written = outputs.write_report(results, folder)
    progress("report", 1, 1)
    messages.note(f"report: {written}")
    if not silent:
        typer.echo(report.comparison_text(results))
        typer.echo(report.kwave_text(results), nl=False)
        for line in study.left_out:
            typer.echo(line)
        for words in study.coarsened:
            typer.echo(f"coarse: {words}")
        typer.echo(f"report: {written}")
    messages.warn(outputs.older_files(folder))
    return summary(study, results, folder, time.monotonic() - start)
