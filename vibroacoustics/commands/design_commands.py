"""Commands on the design space of a study. Heavy imports wait until they are needed."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from .options import Plugins, load_plugins
from .progress import progress_on_stderr

if TYPE_CHECKING:
    from ..design.evaluation import Evaluate
    from ..design.problem import Problem

DESIGNS_NAME: Final = "designs.nc"
STORE_NAME: Final = "chunks"

commands = typer.Typer()


@commands.command("optimise")
def optimise_command(
    study_file: Annotated[
        Path, typer.Argument(metavar="STUDY.toml", help="Study with a table `design`.")
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
    workers: Annotated[
        int,
        typer.Option(min=0, max=1000, help="Local processes that evaluate designs; 0: this one."),
    ] = 0,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Running scheduler of dask.distributed, for workers."),
    ] = None,
    plugin: Plugins = None,
) -> None:
    """Search the design space of a study: the best design, or the front of several objectives.

    Ended at any moment, the same command goes on where it was.
    """
    from .. import report
    from ..design.best_studies import best_studies
    from ..design.optimising import optimise
    from ..design.problem import Problem
    from ..study.loading import load_study
    from . import outputs

    load_plugins(plugin)
    folder = out or Path("reports") / study_file.stem
    study = load_study(study_file)
    outputs.check_folder(folder)
    problem = Problem(study)
    with (
        progress_on_stderr() as progress,
        _evaluate(problem, study_file, folder, workers, scheduler, plugin or []) as evaluate,
    ):
        found = optimise(problem, evaluate, progress)
    files = report.render_designs(found)
    texts = best_studies(problem, found, study_file, folder)
    files |= {name: text.encode() for name, text in texts.items()}
    written = outputs.write_analysis(found, folder, DESIGNS_NAME, files, lambda _: [])
    typer.echo(report.designs_text(found))
    typer.echo(f"designs: {written}")


@contextmanager
def _evaluate(
    problem: "Problem",
    study_file: Path,
    folder: Path,
    workers: int,
    scheduler: str | None,
    plugins: list[Path],
) -> "Iterator[Evaluate]":
    """What evaluates designs: looked up in the folder, else here or by workers."""
    from ..design.search.coded import evaluating
    from ..design.store.chunks import Stored, opened_store
    from ..design.workers.cluster import PIECE, in_pieces, opened_workers, spread
    from ..design.workers.study_task import evaluate_task, study_plan, study_task

    plan = study_plan(problem.study, plugins)
    with opened_store(folder / STORE_NAME, plan) as store:
        if not workers and scheduler is None:
            yield Stored(in_pieces(evaluating(problem), PIECE), store)
            return
        counts = len(problem.design.objectives), len(problem.design.constraints)
        task = study_task(study_file, problem.study, plugins)
        with opened_workers(workers, scheduler) as client:
            yield Stored(spread(client, evaluate_task, task, PIECE, counts), store)
