"""Command that balances a machine on the bench. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

from .command import command
from .options import FileOut, Plugins, Printing, load_plugins
from .outcome import Outcome


@command("balance", "Measurements", "fan/balancing.toml")
def balance_command(
    file: Annotated[Path, "FILE: File of the runs, .toml; `new balance` writes one."],
    out: FileOut = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Balance a machine on the bench from runs with trial weights: weights, bench sheet, page."""
    from ..design.bench.balanced_runs import balance_runs
    from ..design.bench.remarks import remarks
    from . import messages
    from .balancing.page import analysis_of_balancing

    load_plugins(plugin)
    target = printing.target(out or Path("reports") / file.stem)
    result = balance_runs(file)
    doubts = remarks(result)
    messages.warn(doubts)
    return target.outcome(analysis_of_balancing(result, doubts))
