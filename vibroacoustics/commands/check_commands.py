"""Command that tells what is wrong with a file, and what a run of it costs.

Heavy imports wait until it runs.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from ..base.fault import collected
from .options import Plugins, load_plugins
from .progress import progress_on_stderr

commands = typer.Typer()


@commands.command("check")
def check_command(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="A study or a machine.")],
    plugin: Plugins = None,
) -> None:
    """Tell all that is wrong with a study or a machine; of a study, what a run would cost."""
    from ..study.loading import load_study_or_machine
    from ..study.study import Study
    from . import cost_lines

    with collected() as left_out:
        load_plugins(plugin)
        checked = load_study_or_machine(file)
        if not isinstance(checked, Study):
            _print(cost_lines.machine_lines(checked))
        else:
            from ..pipeline.cost import run_cost

            _print(cost_lines.study_lines(checked))
            with progress_on_stderr() as progress:
                cost = run_cost(checked, progress)
            _print(cost_lines.cost_lines(cost))
    what = "nothing else is wrong" if left_out else "nothing is wrong"
    typer.echo(f"{file}: {what}")


def _print(lines: Iterable[str]) -> None:
    for line in lines:
        typer.echo(line)
