"""Commands for designs. Heavy imports wait until they are needed."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from ..base.progress import Progress
from . import messages
from .command import command
from .options import Plugins, Printing, StudyOut, load_plugins
from .outcome import Outcome
from .workers import Workers

if TYPE_CHECKING:
    import xarray as xr

    from ..design.evaluation import Stream
    from ..design.problem import Problem
    from ..report.analysis import Analysis
    from .workers import Opener

SWEEP_NAME: Final = "sweep.nc"
TABLE_NAME: Final = "sweep.csv"
DESIGNS_NAME: Final = "designs.nc"
SWEEP_PIECES: Final = "sweep_pieces"
SEARCH_PIECES: Final = "search_pieces"

StudyFile = Annotated[Path, "STUDY: Study file, .toml, with a table `design`."]


@command("sweep", "Designs", "pipelines/copeland_designs.toml --workers 4")
def sweep_command(
    progress: Progress,
    study_file: StudyFile,
    *,
    out: StudyOut = None,
    workers: Workers,
    plugin: Plugins = None,
    longest: Annotated[
        float, typer.Option("--longest", min=0.0, help="Refuse a sweep that takes longer, hours.")
    ] = 12.0,
    printing: Printing,
) -> Outcome:
    """Compute every design of a study's grid or sample: a dataset, a table and a report.

    Ended at any moment, the same command goes on where it was.
    """
    from .. import report
    from ..design.dataset import table_csv
    from ..design.evaluation import in_pieces
    from ..design.explaining import explained
    from ..design.sweep import as_dataset, prepare, sampling_words, swept
    from . import outputs

    prints = printing.printer()
    load_plugins(plugin)
    opened, is_far = workers.opener(plugin), workers.scheduler is not None
    problem, folder = _problem(study_file, out)
    prepared = prepare(problem, 3600.0 * longest, workers.workers)
    messages.inform(f"plan: {prepared.plan.text}")
    with _evaluating(problem, study_file, folder / SWEEP_PIECES, opened, plugin, is_far) as stream:
        values = swept(prepared, progress, stream)
        search, searched = None, values.searched(problem.design.search.best)
        if searched.any_allowed:
            attributes = values.attributes(sampling_words(problem))
            search = explained(problem, searched, in_pieces(problem, stream), attributes)
    if values.failed:
        messages.warn([f"{values.failed} designs failed; {TABLE_NAME} gives the reasons"])
    results = as_dataset(prepared, values)
    table = {TABLE_NAME: table_csv(results)}
    if search is None:
        messages.warn(["no design meets the constraints: there is no report of the best"])
        analysis = report.analysis_of_no_designs(results)
    else:
        analysis = _analysis(problem, search, study_file, folder)
    analysis = replace(analysis, further={**analysis.further, **table})
    return outputs.Target(folder, prints).outcome(analysis, results, SWEEP_NAME)


@command("optimise", "Designs", "pipelines/copeland_designs.toml --json")
def optimise_command(
    progress: Progress,
    study_file: StudyFile,
    *,
    out: StudyOut = None,
    workers: Workers,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Search the design space of a study: the best design, or the front of several objectives.

    Ended at any moment, the same command goes on where it was.
    """
    from ..design.evaluation import in_pieces
    from ..design.optimising import searched_designs
    from . import outputs

    prints = printing.printer()
    load_plugins(plugin)
    opened, is_far = workers.opener(plugin), workers.scheduler is not None
    problem, folder = _problem(study_file, out)
    with _evaluating(problem, study_file, folder / SEARCH_PIECES, opened, plugin, is_far) as stream:
        search = searched_designs(problem, in_pieces(problem, stream), progress)
    analysis = _analysis(problem, search, study_file, folder)
    return outputs.Target(folder, prints).outcome(analysis, search, DESIGNS_NAME)


def _problem(study_file: Path, out: Path | None) -> "tuple[Problem, Path]":
    """Return the problem of the study, and the folder of its results, which can be written."""
    from ..design.problem import Problem
    from ..design.store.pieces import PLAN_NAME
    from ..stages.radiation import KeptRadiation
    from ..study import loading
    from . import outputs

    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    plans = [f"{name}/{PLAN_NAME}" for name in (SWEEP_PIECES, SEARCH_PIECES)]
    outputs.check_folder(folder, (SWEEP_NAME, DESIGNS_NAME, *plans))
    return Problem(study, KeptRadiation()), folder


def _analysis(
    problem: "Problem", search: "xr.Dataset", study_file: Path, folder: Path
) -> "Analysis":
    """Report of a search, with studies of the best few designs."""
    from .. import report
    from ..design.best_studies import best_studies

    analysis = report.analysis_of_designs(search)
    if report.no_best(search):
        return analysis
    texts = best_studies(problem, search, study_file, folder)
    return replace(analysis, further={name: text.encode() for name, text in texts.items()})


@contextmanager
def _evaluating(
    problem: "Problem",
    study_file: Path,
    store_folder: Path,
    opened: "Opener | None",
    plugins: list[Path] | None,
    is_far: bool,
) -> "Iterator[Stream]":
    """Evaluate pieces of designs: from the store, else here or by workers."""
    from ..design.evaluation import one_by_one
    from ..design.store.pieces import opened_store, stored
    from ..design.workers.study_task import evaluate_task, spread, study_plan, study_task

    plugin_files = plugins or []
    counts = len(problem.design.objectives), len(problem.design.constraints)
    with opened_store(store_folder, study_plan(problem.study, plugin_files)) as store:
        if opened is None:
            yield stored(one_by_one(problem), store, counts)
            return
        task = study_task(study_file, problem.study, plugin_files)
        # Local workers have the cache on disk; others get the transfer vectors with their work.
        far = partial(evaluate_task, radiation=problem.radiation)
        builder = far if is_far else evaluate_task
        with opened() as parallel_map:
            yield stored(spread(parallel_map, builder, task, counts), store, counts)
