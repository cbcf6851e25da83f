"""Command that scores options again. Heavy imports wait until it runs."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from . import messages
from .command import command
from .options import Plugins, Printing, ResultsFile, load_plugins
from .outcome import Outcome


@command("score", "Results", "reports/mine/results.nc --scoring mine.toml")
def score_command(
    results_file: ResultsFile,
    scoring_of: Annotated[
        Path | None,
        typer.Option("--scoring", help="Study file, .toml, with other scales and weights."),
    ] = None,
    out: Annotated[
        Path | None, "Folder of what is written; default: scored, beside the file."
    ] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Score the options again: print the ranking, write results and report with it."""
    from .. import scoring
    from ..results import manifest
    from ..scoring.again import scored_again
    from ..study import loading
    from . import outputs

    load_plugins(plugin)
    folder = out or results_file.parent / "scored"
    outputs.check_folder(folder, outputs.RUN_FILES)
    prints = printing.printer()
    results, _ = outputs.open_run(results_file)
    messages.warn(manifest.mixed(results_file.parent))
    settings = loading.load_study(scoring_of).scoring if scoring_of else None
    with outputs.naming(scoring_of or results_file):
        scored = scored_again(results, settings)
    analysis, files = outputs.write_study(scored, folder, prints)
    silent = replace(analysis, summary=(), shown=())
    return Outcome(scoring.ranking_text(scored), files, analyses={"": silent})
