"""Commands for designs. Heavy imports wait until they are needed."""

from pathlib import Path
from typing import Annotated, Final

import typer

from . import messages
from .options import Plugins, load_plugins
from .progress import progress_on_stderr

SWEEP_NAME: Final = "sweep.nc"
TABLE_NAME: Final = "sweep.csv"

commands = typer.Typer()


@commands.command("sweep")
def sweep_command(
    study_file: Annotated[
        Path, typer.Argument(metavar="STUDY.toml", help="The study with a table `design`.")
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
    plugin: Plugins = None,
    longest: Annotated[
        float,
        typer.Option(
            "--longest", metavar="HOURS", min=0.0, help="Refuse a sweep that takes longer."
        ),
    ] = 12.0,
) -> None:
    """Compute every design of a study's grid or sample: a dataset and a table."""
    from ..design.dataset import table_csv
    from ..design.problem import Problem
    from ..design.sweep import prepare, swept
    from ..study import loading
    from . import outputs

    load_plugins(plugin)
    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    prepared = prepare(Problem(study), 3600.0 * longest)
    typer.echo(f"plan: {prepared.plan.text}")
    with progress_on_stderr() as progress:
        results = swept(prepared, progress)
    written = outputs.write_analysis(
        results, folder, SWEEP_NAME, {TABLE_NAME: table_csv(results)}, lambda _: []
    )
    failed = int((results["failure"] > 0).sum())
    if failed:
        messages.warn([f"{failed} designs failed; {TABLE_NAME} tells why"])
    typer.echo(f"designs: {written}")
